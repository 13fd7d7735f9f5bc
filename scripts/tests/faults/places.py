"""Finds the built files that the trials of faults and exits need."""
from pathlib import Path
from typing import Any

from build import inputs, jdk, projects
from build.places import BUILD, CSHARP, HOST_JAR, PLAYER, ROOT, SHIM

PROBE = ROOT / "unity/Headless~/Tests/Simulation/Probe/probe.fbs"
PROGRAMS = ROOT / "unity/Headless~/Faults/programs"
RUNTIMES = ["mono-sgen", "mono-boehm", "coreclr"]


def places(runtimes: list[str], jdks: list[Path]) -> dict[str, Any]:
    """Returns the settings of the trials by name: runtimes, JDKs and the required files."""
    files = {"program": CSHARP / "Collektive.Faults.exe", "player": PLAYER, "shim": SHIM, "host": HOST_JAR,
             "incompatible": BUILD / "incompatible-host.jar", "schema": PROBE,
             "jar": projects.programs_jar(inputs.schema(PROBE), inputs.programs(PROGRAMS))}
    return {name: str(file) for name, file in files.items()} | {"runtimes": runtimes, "jdks": [str(home) for home in jdks], "jobs": 2}


def newest_jdk() -> dict[str, Any]:
    """Returns the settings of trials on Mono with the JDK that runs simulations."""
    return places(RUNTIMES[:1], [jdk.find_jdk()])


def all_runtimes() -> dict[str, Any]:
    """Returns the settings of trials on every runtime and JDK."""
    return places(RUNTIMES, jdk.test_jdks())
