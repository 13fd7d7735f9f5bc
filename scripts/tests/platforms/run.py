"""Tests the shim for other platforms: `run.py RESULTS [--short] PLATFORM...`.

Builds it for each platform, checks the files, and runs the tests if possible. With --short, runs only tests of code that depends on the processor.
"""
import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from build import jdk, lock, platforms, processes
from build.places import ROOT
from tests import junit

# The labels of tests that are omitted. These tests are slow or repeat steps, and an emulated JVM takes seconds to start.
EXCLUDED = "slow|repeats"
# The names of tests that cannot be emulated. Of the tests that exist for both placements, only those in this process run, because qemu cannot start an
# emulated program from another one. It also does not report why a program cannot be executed, and does not limit the memory of a program.
NOT_EMULATED = "^own_([^o]|o[^w]|own_(ends_with_its_parent|with_a_bad_launcher|out_of_memory))"
# The tests of memory order, signals, calls and floating-point numbers.
SHORT = ["-R", "neighbours_|echo_of_random_data|exceptions|implicit_null_checks|signal_handlers|callers_take_turns"]


def run(results: Path, names: list[str], selection: list[str]) -> int:
    """Runs the tests and returns the exit code. Notes list the tests that cannot run here."""
    lock.shared()
    platforms.setup_tests(names)
    code, java = 0, {}
    with (results / "notes").open("w") as file:
        for name in names:
            reason = platforms.unavailable_reason(name)
            if reason is None:
                code = run_shim(name, results, selection) or code
                java[name] = platforms.java_command(name)
                file.writelines(describe(name, results / f"{name}.xml"))
            else:
                file.write(f"{name}: not run: {reason}\n")
    # The tests run scenes, which lock the outputs themselves.
    lock.release()
    environment = {**platforms.emulator_environment(), "COLLEKTIVE_CROSS": str(platforms.CROSS), "COLLEKTIVE_PLATFORMS": " ".join(names),
                   "COLLEKTIVE_JAVA_COMMANDS": json.dumps(java), "COLLEKTIVE_JDK": str(jdk.find_jdk())}
    command = [sys.executable, "-I", "-B", "-m", "pytest", "-c", str(ROOT / "scripts/tests/pytest.ini"), "--junitxml", str(results / "pytest.xml"),
               str(Path(__file__).parent)]
    return processes.call(command, env=environment) or code


def run_shim(name: str, results: Path, selection: list[str]) -> int:
    """Runs the tests of a platform's shim with the platform's JRE. Returns CTest's exit code."""
    jre = platforms.runnable_jre(name)
    environment = {**platforms.emulator_environment(), "CLK_TEST_JAVA_HOME": str(jre)}
    if name == "win-x64":
        subprocess.run([platforms.wine() or "wine", "wineboot", "-i"], env=environment, check=True)
    return processes.call(["ctest", "--test-dir", str(platforms.CROSS / name), "--output-on-failure", "-j", "2", "-LE", EXCLUDED, "-E", NOT_EMULATED,
                           *selection, "--output-junit", str(results / f"{name}.xml")], env=environment)


def describe(name: str, report: Path) -> list[str]:
    """Returns lines with the number of executed tests, and with the reason for each skipped test."""
    skipped = junit.read_skipped(str(report))
    ran = len(junit.read(str(report)))
    return [f"{name}: {ran} tests ran, {len(skipped)} were skipped\n", *(f"  {test}: {reason}\n" for test, reason in skipped.items())]


if __name__ == "__main__":
    is_short = "--short" in sys.argv
    sys.exit(run(Path(sys.argv[1]), [word for word in sys.argv[2:] if word != "--short"], SHORT if is_short else []))
