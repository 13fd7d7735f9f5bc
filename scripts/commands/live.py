"""Runs a scenario in real time and prints the address of a local page that shows it. In the page, change the Kotlin programs, their parameters and
the scene while the simulation runs. Documentation~/live.md describes the page.

SCENARIO is a scenario file, or the name of a sample or of a lesson: gradient, channel, leader, collection, gossip, healing, sparse, flocking. By default
it is the case study, GradientAscent. Samples and lessons are copied to out/live/NAME once. To start again with the original, delete that
folder.

Ctrl-C ends the simulation. Exit code: 0 the page was shown; 1 it was not."""
import argparse
import json
from pathlib import Path

from build import fetch, graph, processes
from build.console import Failure
from build.places import LIVE_PYTHON, ROOT
from live import examples


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
    for value in arguments.values:
        if value.find("=") < 1:
            raise Failure(f"--set {value}: write it as --set KEY=VALUE")
    graph.build("runtime", "replay_page")
    fetch.fetch("live", "kotlinc")
    scenario = Path(arguments.scenario)
    if not scenario.exists():
        scenario = examples.find(arguments.scenario) or scenario
    scenario = scenario.resolve()
    if examples.is_example(scenario):
        scenario = examples.copy(scenario)
    options = {**vars(arguments), "scenario": str(scenario)}
    del options["run"]
    server: list[str | Path] = [LIVE_PYTHON, "-I", ROOT / "scripts/live/server.py", json.dumps(options)]
    code = processes.call(server)
    processes.end_orphans()
    return code
