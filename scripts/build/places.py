"""Defines the locations of files and folders in the checkout."""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
COLLEKTIVE = ROOT / "collektive"
# The build tree of CMake and Ninja, which build.graph configures.
GRAPH = BUILD / "cmake"
CSHARP = BUILD / "csharp"
SHIM = GRAPH / "native-shim"
FLATC = BUILD / "flatc-linux-x64/flatc"
LOGS = BUILD / "log"
RESULTS = BUILD / "results"
# The Python environment of linters and tests.
TEST_PYTHON = BUILD / "python/bin/python"
EXPERIMENTS_PYTHON = BUILD / "experiments/bin/python"
# The Python environment of the server of live runs.
LIVE_PYTHON = BUILD / "live/bin/python"
NODE_MODULES = BUILD / "npm/node_modules"
JVM = ROOT / "jvm-host"
# Programs are linked to LIBRARY_JAR, or on Collektive's own runtime to ADAPTER_JAR. The host loads both.
HOST_JAR = JVM / "host/target/collektive-host.jar"
LIBRARY_JAR = JVM / "host/target/collektive-library.jar"
ADAPTER_JAR = JVM / "host/target/collektive-adapter.jar"
TESTING_JAR = JVM / "testing/target/collektive-testing.jar"
TOOLS_JAR = JVM / "tools/target/collektive-tools.jar"
SAMPLES_JAR = JVM / "programs/target/collektive-programs.jar"
# The folder of the samples' program libraries.
SAMPLE_PROGRAMS = BUILD / "generated/sample-programs"
BENCH_JAR = JVM / "bench/target/collektive-bench.jar"
GENERATOR_JAR = JVM / "generator/target/collektive-generator.jar"
# The sources of org.collektive.links, which are compiled together with programs for another runtime.
LINKS = JVM / "stdlib/src/main/kotlin/org/collektive/links"
PLAYER = CSHARP / "Collektive.Player.exe"


def compiler_plugin() -> Path:
    """Returns the jar of the Kotlin compiler plugin, whose name contains the version."""
    return next(iter((JVM / "compiler-plugin/target").glob("compiler-plugin-[0-9]*[0-9].jar")))


def script(name: str, *arguments: str | Path) -> list[str | Path]:
    """Returns the command line of a Python script of this checkout, isolated from the caller's settings."""
    return [sys.executable, "-I", ROOT / "scripts" / name, *arguments]
