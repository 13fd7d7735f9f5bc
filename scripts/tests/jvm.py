"""Runs the tests of the JVM modules, which the build graph has compiled: `jvm.py RESULTS [OPTION OF MAVEN]...`."""
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import maven
from build.places import JVM


def run(results: Path, options: list[str]) -> int:
    """Runs the tests, collects the reports of all modules, and returns Maven's exit code."""
    for report in JVM.glob("*/target/surefire-reports/TEST-*.xml"):
        report.unlink()
    modules = list(maven.read_modules().values())
    code = maven.run(modules, set(), ["test", "-Dmaven.test.failure.ignore=true", *options], tests=True)
    for report in JVM.glob("*/target/surefire-reports/TEST-*.xml"):
        shutil.copy(report, results / f"{report.parts[-4]}-{report.name}")
    return code


if __name__ == "__main__":
    sys.exit(run(Path(sys.argv[1]), sys.argv[2:]))
