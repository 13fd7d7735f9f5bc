"""Recorded runs: the reader of records on a plain JVM, without Unity."""
from pathlib import Path

from build import processes
from build.jdk import find_jdk
from build.places import HOST_JAR, TOOLS_JAR

# The exit code for a record or a jar that cannot be used.
UNUSABLE = 2


def read(*words: str | Path) -> int:
    """Runs the reader, which prints its results, and returns its exit code."""
    return processes.call([find_jdk() / "bin/java", "-cp", f"{TOOLS_JAR}:{HOST_JAR}", "org.collektive.tools.record.RecordsKt", *words])
