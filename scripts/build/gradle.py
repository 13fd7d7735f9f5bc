"""Completes the Gradle build of a project, which IDEs read. GradleBuild.cs does the same in Unity's editor."""
from pathlib import Path

from build.places import FLATC, GENERATOR_JAR, HOST_JAR, LIBRARY_JAR, ROOT, TESTING_JAR, compiler_plugin


def fill(text: str, schema: str, programs: str) -> str:
    """Replaces the placeholders in a build.gradle.kts with the paths of files in this clone and in the project."""
    values: dict[str, str | Path] = {
        "HOST": HOST_JAR, "LIBRARY": LIBRARY_JAR, "TESTING": TESTING_JAR, "PLUGIN": compiler_plugin(), "GENERATOR": GENERATOR_JAR, "FLATC": FLATC,
        "TYPES": ROOT / "schema", "SCHEMAS": schema, "PROGRAMS": programs}
    for name, value in values.items():
        text = text.replace(f"@{name}@", _escape(str(value)))
    return text


def _escape(path: str) -> str:
    """Escapes a path for a Kotlin string."""
    return path.replace("\\", "\\\\").replace('"', '\\"').replace("$", "\\$")
