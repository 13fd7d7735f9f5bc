"""Reads recorded runs with a JVM and without Unity."""
from pathlib import Path

from build import processes
from build.jdk import find_jdk
from build.places import HOST_JAR, TOOLS_JAR

# The reader's exit code for an unusable record or jar.
UNUSABLE = 2


def read(*words: str | Path) -> int:
    """Runs the reader, which prints its results itself. Returns its exit code."""
    return processes.call([find_jdk() / "bin/java", "-cp", f"{TOOLS_JAR}:{HOST_JAR}", "org.collektive.tools.record.RecordsKt", *words])
