"""Runs the tests in the package, which Unity's test framework can also run in the editor: `unity.py RESULTS`."""
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import jdk, managed, processes
from build.places import ADAPTER_JAR, CSHARP, HOST_JAR, LIBRARY_JAR, ROOT, SAMPLE_PROGRAMS

ASSEMBLIES = ("Collektive.Unity.Tests", "Collektive.Unity.PublicApi.Tests", "Collektive.Unity.Editor.Tests")


def run(results: Path) -> int:
    """Runs the tests of all assemblies. Returns the exit code of the last assembly that failed, or 0."""
    # The tests need a project in which the package is installed, with its jars, a sample and a JVM.
    project = results / "project"
    jars = project / "Packages/org.collektive.unity/unity/Jvm~"
    shutil.rmtree(project, ignore_errors=True)
    jars.mkdir(parents=True)
    for jar in (HOST_JAR, LIBRARY_JAR, ADAPTER_JAR):
        (jars / jar.name).symlink_to(jar)
    sample = project / "Packages/org.collektive.unity/unity/Samples~/LeaderElection/leader_election.clkprograms"
    sample.parent.mkdir(parents=True)
    sample.symlink_to(SAMPLE_PROGRAMS / sample.name)
    environment = {**managed.environment("mono-sgen"), "COLLEKTIVE_ROOT": str(ROOT), "JAVA_HOME": str(jdk.find_jdk())}
    code = 0
    for name in ASSEMBLIES:
        command = managed.command("mono-sgen", CSHARP / "Collektive.TestRunner.exe", "--results", results / f"{name}.xml", CSHARP / f"{name}.dll")
        code = processes.call(command, env=environment, cwd=project) or code
    return code


if __name__ == "__main__":
    sys.exit(run(Path(sys.argv[1])))
