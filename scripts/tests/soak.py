"""Tests that memory, threads and file descriptors do not grow while nodes join, fail and leave: `soak.py MINUTES [results=FILE.xml]`."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import inputs, jdk, managed, processes, projects
from build.places import CSHARP, HOST_JAR
from tests.faults.places import PROBE, PROGRAMS


def run(minutes: float, words: list[str]) -> int:
    """Runs the scene and returns its exit code, which is 0 if nothing grows."""
    jar = projects.programs_jar(inputs.schema(PROBE), inputs.programs(PROGRAMS))
    command = managed.command("mono-sgen", CSHARP / "Collektive.Soak.exe", f"home={jdk.find_jdk()}", f"host={HOST_JAR}", f"jar={jar}",
                              f"seconds={60 * minutes:g}", *words)
    return processes.call(command, env=managed.environment("mono-sgen"))


if __name__ == "__main__":
    sys.exit(run(float(sys.argv[1]), sys.argv[2:]))
