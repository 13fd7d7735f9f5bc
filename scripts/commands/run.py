"""Runs a scenario without Unity: compiles its C# scripts and Kotlin programs (only if they changed), plays its scene, and writes its outputs to
--out: manifest.json, metrics.csv, replay.html, pictures and run.clkrec (all frames, for ./collektive replay and diff), as the scenario asks.
Documentation~/headless.md describes the keys of the scenario file.

A tick of which every round fails ends the run; with --keep-going it goes on.

Exit code: 0 the simulation reached its end; 1 it stopped early, or rounds, sensors or actuators failed; 130 Ctrl-C; any that a script passes to
Application.Quit."""
import argparse
import os
from pathlib import Path

from build import graph, outputs, player, projects
from build.console import logged, say
from build.jdk import find_jdk
from build.places import BUILD, NODE_MODULES, ROOT

REPLAY_PAGE = BUILD / "replay.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/NAME-seedK below the current folder)")
    parser.add_argument("--recording", metavar="FILE.jfr", help="make a flight recording of the JVM")
    parser.add_argument("--folder", metavar="DIR", help=argparse.SUPPRESS)
    add_run_arguments(parser)


def add_run_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the options of all commands that run scenarios."""
    parser.add_argument("--overwrite", action="store_true", help="remove the results of an earlier run in that folder first")
    parser.add_argument("--seed", metavar="K", help="seed instead of the scenario's")
    parser.add_argument("--seconds", metavar="S", help="simulated seconds instead of the scenario's")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="values",
                        help="another value of a key of the scenario: network.loss=0.1, parameters.PROGRAM.NAME=2. Any other name sets a public "
                             "field of the scene builder: nodes=100")
    parser.add_argument("--keep-going", action="store_true", help="continue after a tick of which every round failed")
    parser.add_argument("--trust-jvm", action="store_true",
                        help="allow JVM settings that write files, open ports or load code: Documentation~/trust.md")


def run(arguments: argparse.Namespace) -> int:
    graph.build("runtime")
    reading = [word for value in arguments.values for word in ("--set", value)]
    if arguments.folder is not None:
        reading += ["--folder", arguments.folder]
    for option in ("seed", "seconds"):
        if getattr(arguments, option) is not None:
            reading += [f"--{option}", getattr(arguments, option)]
    if arguments.trust_jvm:
        reading.append("--trust-jvm")
    plan = player.plan(arguments.scenario, reading)
    jar, dll = plan.programs_jar(), plan.scripts_dll()
    words: list[str] = []
    if plan["replay"]:
        graph.build("replay_page")
        words += ["--template", str(REPLAY_PAGE)]
    name = os.path.basename(arguments.scenario).removesuffix(".json")
    out = arguments.out or f"out/{name}-seed{arguments.seed or plan['seed']}"
    projects.own_program(jar)
    if arguments.recording is not None:
        words += ["--recording", os.path.abspath(arguments.recording)]
    if arguments.keep_going:
        words.append("--keep-going")
    has_pictures = plan["pictures"]
    say(f"running {arguments.scenario}")
    with outputs.prepared(Path(out), arguments.overwrite):
        # Scripts may change the current folder.
        code = player.run(arguments.scenario, plan, jar, dll, find_jdk(), ["--out", os.path.realpath(out), *words, *reading])
        outputs.require(Path(out), outputs.WITHOUT_PICTURES if has_pictures else outputs.COMPLETE, code)
    if code != 0:
        return code
    if has_pictures:
        pictures = ROOT / "unity/Headless~/Replay/pictures.mjs"
        logged("pictures", ["node", pictures, f"{out}/replay.html", out], env={**os.environ, "COLLEKTIVE_NODE_MODULES": str(NODE_MODULES)})
        outputs.complete(Path(out))
    print("\n".join(outputs.summary(Path(out))))
    return 0
