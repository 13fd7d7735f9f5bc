"""Tests the JVM side for race conditions with jcstress: `stress.py RESULTS.xml OPTION...`."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import jdk, processes
from build.places import BUILD, JVM


def run(results: Path, options: list[str]) -> int:
    """Runs jcstress and returns its exit code."""
    # jcstress writes its own results to the working directory.
    work = BUILD / "stress"
    work.mkdir(exist_ok=True)
    results.parent.mkdir(parents=True, exist_ok=True)
    target = JVM / "stress/target"
    return processes.call([jdk.find_jdk() / "bin/java", "-cp", f"{target}/collektive-stress.jar:{target}/lib/*", "org.collektive.stress.Main", results,
                           "-r", work / "report", *options], cwd=work)


if __name__ == "__main__":
    sys.exit(run(Path(sys.argv[1]), sys.argv[2:]))
