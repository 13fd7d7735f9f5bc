"""Runs the case study, environment-aware gradient ascent: 500 bodies move around obstacles to a source in 60 simulated seconds. Writes
manifest.json, metrics.csv, replay.html (open it in a browser) and three pictures to --out."""
import argparse
import json
from pathlib import Path

from build.places import ROOT
from commands.run import run_scenario

SCENARIO = ROOT / "unity/Samples~/GradientAscent/scenario.json"


def _whole_number(text: str) -> int:
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number")
    return int(text)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--nodes", type=_whole_number, metavar="N", help="number of bodies (default: 500)")
    parser.add_argument("--seconds", metavar="S", help="simulated seconds (default: 60)")
    parser.add_argument("--seed", default="1", metavar="K", help="seed (default: 1)")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/demo-seedK, replacing an earlier demo)")
    parser.add_argument("--overwrite", action="store_true", help="replace the results of an earlier run in that folder")


def run(arguments: argparse.Namespace) -> int:
    out = arguments.out or f"out/demo-seed{arguments.seed}"
    values = [] if arguments.nodes is None else [f"nodes={arguments.nodes}"]
    return run_scenario(str(SCENARIO), out=out, overwrite=arguments.overwrite or (not arguments.out and _is_demo(Path(out, "manifest.json"))),
                        seed=arguments.seed, seconds=arguments.seconds, values=values)


def _is_demo(manifest: Path) -> bool:
    """Returns whether a manifest is from a demo. Another scenario named demo.json has the same default folder."""
    try:
        found = json.loads(manifest.read_bytes())
    except (OSError, ValueError):
        return False
    return isinstance(found, dict) and (found.get("folder"), found.get("file")) == (str(SCENARIO.parent), SCENARIO.name)
