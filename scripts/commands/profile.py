"""Runs a scenario as `./collektive run` does, with a flight recording of the JVM, and prints what it contains: times of ticks, for each program
its rounds and the methods where their time goes, allocation, and pauses. The recording is profile.jfr in --out; JDK Mission Control and the
JDK's jfr command open it."""
import argparse
import os
from pathlib import Path

from build import processes
from build.jdk import find_jdk
from build.places import HOST_JAR, TOOLS_JAR
from commands import run as run_command


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/NAME-profile, where it replaces the earlier ones)")
    run_command.add_run_arguments(parser)


def run(arguments: argparse.Namespace) -> int:
    out = arguments.out or f"out/{os.path.basename(arguments.scenario).removesuffix('.json')}-profile"
    recording = Path(out, "profile.jfr")
    before = _modified(recording)
    # A run whose rounds failed has a recording, too: the one that is needed most.
    code = run_command.run_scenario(**{**vars(arguments), "out": out, "overwrite": arguments.overwrite or not arguments.out, "recording": str(recording)})
    # A run that could not begin leaves an earlier recording.
    if _modified(recording) not in (0, before):
        processes.call([find_jdk() / "bin/java", "-XX:+UseSerialGC", "-cp", f"{TOOLS_JAR}:{HOST_JAR}", "org.collektive.tools.profile.ProfileReport",
                        recording])
    return code


def _modified(file: Path) -> int:
    return file.stat().st_mtime_ns if file.is_file() else 0
