"""Runs a scenario in real time and prints the address of a local page that shows it. In the page, change the Kotlin programs, their parameters and
the scene while the simulation runs. Documentation~/live.md describes the page.

SCENARIO is a scenario file, or the name of a sample or of a lesson: gradient, channel, leader, collection, gossip, healing, sparse, flocking. By default
it is the case study, GradientAscent. Samples and lessons are copied to out/live/NAME once. To start again with the original, delete that
folder.

Ctrl-C ends the simulation. Exit code: 0 the simulation was started; 1 it was not."""
import argparse
import json
import shutil
from pathlib import Path

from build import fetch, graph, processes, sample_programs
from build.console import Failure
from build.places import LIVE_PYTHON, ROOT

LESSONS = ROOT / "scripts/lessons"
# Files that only Unity needs.
UNITY_FILES = ("*.meta", "*.unity", "*.asmdef", "*.mat", "*.prefab")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO", nargs="?", default="GradientAscent")
    parser.add_argument("--port", type=_port, default=0, metavar="N", help="port on 127.0.0.1 (default: any free port)")
    parser.add_argument("--no-browser", action="store_true", help="do not open the page in a browser")
    parser.add_argument("--seed", metavar="K", help="seed instead of the scenario's")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="values", help="see ./collektive run --help")
    parser.add_argument("--trust-jvm", action="store_true", help="see ./collektive run --help")


def _port(text: str) -> int:
    if not text.isascii() or not text.isdigit() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"'{text}' is not a port from 0 to 65535")
    return int(text)


def run(arguments: argparse.Namespace) -> int:
    graph.build("runtime", "replay_page")
    fetch.fetch("live", "kotlinc")
    scenario = Path(arguments.scenario)
    if not scenario.exists():
        named = [folder / arguments.scenario / "scenario.json" for folder in (sample_programs.SAMPLES, LESSONS)]
        scenario = next(filter(Path.is_file, named), scenario)
    scenario = scenario.resolve()
    if scenario.parent.parent in (sample_programs.SAMPLES, LESSONS):
        scenario = copy_sample(scenario, Path("out/live") / scenario.parent.name)
    options = {**vars(arguments), "scenario": str(scenario)}
    del options["run"]
    server: list[str | Path] = [LIVE_PYTHON, "-I", ROOT / "scripts/live/server.py", json.dumps(options)]
    code = processes.call(server)
    processes.end_orphans()
    return code


def copy_sample(scenario: Path, folder: Path) -> Path:
    """Copies a sample or lesson with its Kotlin, unless the folder exists. Returns the scenario of the copy."""
    copy = folder.absolute() / scenario.name
    if copy.is_file():
        return copy
    if folder.exists():
        raise Failure(f"'{folder}' exists and has no {scenario.name}: delete or rename the folder")
    shutil.copytree(scenario.parent, folder, ignore=shutil.ignore_patterns(*UNITY_FILES))
    if scenario.parent.parent == LESSONS:
        return copy
    (schema,) = scenario.parent.glob("*.fbs")
    shutil.copytree(sample_programs.folder(schema), folder / "programs")
    values = json.loads(scenario.read_text(encoding="utf-8"))
    values["programs"] = "programs"
    copy.write_text(json.dumps(values, indent=2) + "\n", encoding="utf-8")
    return copy
