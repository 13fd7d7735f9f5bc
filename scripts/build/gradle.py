"""Fills in the Gradle build of a project, which IDEs read. Unity's editor does the same (GradleBuild.cs)."""
from pathlib import Path

from build.places import FLATC, GENERATOR_JAR, HOST_JAR, LIBRARY_JAR, ROOT, TESTING_JAR, compiler_plugin


def fill(text: str, schema: str, programs: str) -> str:
    """Replaces the names in a build.gradle.kts by files of this clone and of the project."""
    values: dict[str, str | Path] = {
        "HOST": HOST_JAR, "LIBRARY": LIBRARY_JAR, "TESTING": TESTING_JAR, "PLUGIN": compiler_plugin(), "GENERATOR": GENERATOR_JAR, "FLATC": FLATC,
        "TYPES": ROOT / "schema", "SCHEMAS": schema, "PROGRAMS": programs}
    for name, value in values.items():
        text = text.replace(f"@{name}@", _escape(str(value)))
    return text


def _escape(path: str) -> str:
    """Returns a path as the content of a string of Kotlin."""
    return path.replace("\\", "\\\\").replace('"', '\\"').replace("$", "\\$")
