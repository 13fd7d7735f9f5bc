"""Runs the C# tests on one runtime and one JVM: `csharp.py RESULTS JDK RUNTIME [OPTION OF THE TEST RUNNER]...`.

With COLLEKTIVE_TEST_PLACEMENT=OwnProcess, the JVM runs in a separate process. Tests of the category OwnProcess need this placement. Tests of the category
Debugger also need it, or must run without other tests (`--only Debugger`). Tests of the category AnyPlacement are omitted with it, because the placement
does not affect them.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import inputs, managed, projects
from build.places import CSHARP, HOST_JAR, ROOT

PROBE = ROOT / "unity/Headless~/Tests/Simulation/Probe"


def run(results: Path, jdk: str, runtime: str, options: list[str]) -> int:
    """Runs the tests, and returns the exit code of the test runner."""
    schema = inputs.schema(PROBE / "probe.fbs")
    jar, other = (projects.programs_jar(schema, inputs.programs(PROBE / folder)) for folder in ("programs", "other"))
    environment = {**managed.environment(runtime), "COLLEKTIVE_ROOT": str(ROOT), "COLLEKTIVE_HOST_JAR": str(HOST_JAR),
                   "COLLEKTIVE_TEST_JAVA_HOME": jdk, "COLLEKTIVE_PROBE_JAR": str(jar), "COLLEKTIVE_OTHER_JAR": str(other)}
    if os.environ.get("COLLEKTIVE_TEST_PLACEMENT") == "OwnProcess":
        others = ["AnyPlacement"]
    else:
        others = ["OwnProcess"] if "Debugger" in options else ["OwnProcess", "Debugger"]
    options = [*options, *(word for other in others for word in ("--without", other))]
    command = managed.command(runtime, CSHARP / "Collektive.TestRunner.exe", "--results", results / "csharp.xml", *options,
                              CSHARP / "Collektive.Headless.Tests.dll")
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True, errors="replace")
    assert process.stdout is not None
    for line in process.stdout:
        print(line, end="", flush=True)
        if match := re.match(r"(\d+) tests of category Mono were skipped", line):
            notes = f"{match[1]} C# tests were skipped on {runtime}: its hashes need OpenSSL 1.1, and limits of time are Mono's\n"
            (results / "notes").write_text(notes)
    return process.wait()


if __name__ == "__main__":
    sys.exit(run(Path(sys.argv[1]), sys.argv[2], sys.argv[3], sys.argv[4:]))
