"""Runs a scenario without Unity. Compiles its C# scripts and Kotlin programs if they changed, runs the scene, and writes the outputs that the
scenario selects to --out: manifest.json, metrics.csv, replay.html, pictures, and run.clkrec for ./collektive replay and diff.
Documentation~/headless.md describes scenario files.

The run stops after a tick in which all rounds failed, unless --keep-going is set.

Exit code: 0 the simulation reached its end; 1 it stopped early, or rounds, components or handlers failed; 130 Ctrl-C; any code that a script
passed to Application.Quit."""
import argparse
import os
from pathlib import Path

from build import graph, outputs, player, projects
from build.console import Failure, print_progress, run_logged
from build.jdk import find_jdk
from build.places import BUILD, NODE_MODULES, ROOT

REPLAY_PAGE = BUILD / "replay.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/NAME-seedK)")
    parser.add_argument("--debug", metavar="PORT", nargs="?", const="5005", help="wait for a debugger to attach to the JVM on this port of "
                        "127.0.0.1 (default: 5005); disables the time limit of ticks")
    parser.add_argument("--recording", metavar="FILE.jfr", help="write a flight recording of the JVM")
    parser.add_argument("--folder", metavar="DIR", help=argparse.SUPPRESS)
    add_run_arguments(parser)


def add_run_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the options of all commands that run scenarios."""
    parser.add_argument("--overwrite", action="store_true", help="replace the results of an earlier run in that folder")
    parser.add_argument("--seed", metavar="K", help="seed instead of the scenario's")
    parser.add_argument("--seconds", metavar="S", help="simulated seconds instead of the scenario's")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="values",
                        help="override a key of the scenario: network.loss=0.1, parameters.PROGRAM.NAME=2; any other name sets a public field of the "
                             "scene builder: nodes=100")
    parser.add_argument("--keep-going", action="store_true", help="continue after a tick in which all rounds failed")
    parser.add_argument("--trust-jvm", action="store_true",
                        help="allow JVM settings that write files, open ports or load code (Documentation~/trust.md)")


def run_scenario(scenario: str, **options: object) -> int:
    """Runs a scenario with these options, the others at their defaults."""
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return run(parser.parse_args(["--", scenario], argparse.Namespace(**options)))


def run(arguments: argparse.Namespace) -> int:
    if arguments.recording is not None:
        outputs.require_replaceable(arguments.recording, b"FLR\0", "--recording")
        # Otherwise, the recording could replace a result such as metrics.csv.
        if not arguments.recording.endswith(".jfr"):
            raise Failure(f"--recording '{arguments.recording}': the name must end in .jfr")
    graph.build("runtime")
    scenario_options = [word for value in arguments.values for word in ("--set", value)]
    if arguments.folder is not None:
        scenario_options += ["--folder", arguments.folder]
    for option in ("seed", "seconds"):
        if getattr(arguments, option) is not None:
            scenario_options += [f"--{option}", getattr(arguments, option)]
    if arguments.trust_jvm:
        scenario_options.append("--trust-jvm")
    plan = player.plan(arguments.scenario, scenario_options)
    jar, dll = plan.programs_jar(), plan.scripts_dll()
    words: list[str] = []
    if plan["replay"]:
        graph.build("replay_page")
        words += ["--template", str(REPLAY_PAGE)]
    name = os.path.basename(arguments.scenario).removesuffix(".json")
    out = arguments.out or f"out/{name}-seed{arguments.seed or plan['seed']}"
    projects.record_own_program(jar)
    if arguments.recording is not None:
        words += ["--recording", os.path.abspath(arguments.recording)]
    if arguments.debug is not None:
        words += ["--debug", arguments.debug]
    if arguments.keep_going:
        words.append("--keep-going")
    has_pictures = plan["pictures"]
    # The player reads the scenario, data and jars again.
    plan.require_unchanged()
    print_progress(f"running {arguments.scenario}")
    with outputs.open_folder(Path(out), arguments.overwrite):
        # Scripts may change the current folder.
        code = player.run(arguments.scenario, plan, jar, dll, find_jdk(), ["--out", os.path.realpath(out), *words, *scenario_options])
        plan.report_changes()
        outputs.require(Path(out), outputs.WITHOUT_PICTURES if has_pictures else outputs.COMPLETE, code)
    if code != 0:
        return code
    if has_pictures:
        pictures = ROOT / "unity/Headless~/Replay/pictures.mjs"
        run_logged("pictures", ["node", pictures, f"{out}/replay.html", out], env={**os.environ, "COLLEKTIVE_NODE_MODULES": str(NODE_MODULES)})
        outputs.complete(Path(out))
    print("\n".join(outputs.summary(Path(out))))
    return 0
