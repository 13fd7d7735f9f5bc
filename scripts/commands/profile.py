"""Runs a scenario like `./collektive run`, makes a flight recording of the JVM and prints a report: tick times, hot methods of each program,
allocation and pauses. The recording is profile.jfr in --out. Open it in JDK Mission Control or with the jfr command."""
import argparse
import os
from pathlib import Path

from build import processes
from build.jdk import environment, find_jdk
from build.places import HOST_JAR, TOOLS_JAR
from commands import run as run_command


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/NAME-profile, replacing earlier results)")
    run_command.add_run_arguments(parser)


def run(arguments: argparse.Namespace) -> int:
    out = arguments.out or f"out/{os.path.basename(arguments.scenario).removesuffix('.json')}-profile"
    recording = Path(out, "profile.jfr")
    before = _modified(recording)
    # A run whose rounds failed has a recording, too.
    code = run_command.run_scenario(**{**vars(arguments), "out": out, "overwrite": arguments.overwrite or not arguments.out, "recording": str(recording)})
    # If a run cannot begin, an earlier recording remains.
    if _modified(recording) not in (0, before):
        report = processes.call([find_jdk() / "bin/java", "-XX:+UseSerialGC", "-cp", f"{TOOLS_JAR}:{HOST_JAR}", "org.collektive.tools.profile.ProfileReport",
                                 recording], env=environment())
        return code or report
    return code


def _modified(file: Path) -> int:
    return file.stat().st_mtime_ns if file.is_file() else 0
