"""Checks scenarios and experiments before their runs. For a scenario, compiles its C# and Kotlin and runs one tick, which checks all keys, fields,
metrics, jars, names of programs and parameters. For an experiment, checks all keys and values, makes three trial runs, and prints the number of runs
and the estimated time. For a folder, checks all scenarios and experiments in it, but not in its subfolders. Writes no results.

Exit code: 0 all are valid; 1 at least one is not."""
import argparse
import os
import re
import signal
import sys
import tempfile
from pathlib import Path

from build import graph, lock, player, processes
from build.console import Failure
from build.jdk import find_jdk
from build.places import COLLEKTIVE

SCENARIO, EXPERIMENT = "scene", "scenario"
"""Required keys of the two kinds of files."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("paths", metavar="FILE.json|DIR", type=Path, nargs="+")
    parser.add_argument("--trust-jvm", action="store_true",
                        help="allow JVM settings that write files, open ports or load code (Documentation~/trust.md)")


def run(arguments: argparse.Namespace) -> int:
    files = [(file, kind) for path in arguments.paths for file, kind in find_files(path)]
    graph.build("runtime")
    trust = ["--trust-jvm"] if arguments.trust_jvm else []
    # Scenarios come first, because the check of an experiment releases the lock of the outputs.
    ordered = sorted(files, key=lambda entry: entry[1] != SCENARIO)
    invalid = [file for file, kind in ordered if not (_check_scenario if kind == SCENARIO else _check_experiment)(file, trust)]
    for file, kind in files:
        print(f"{file}: {'invalid' if file in invalid else 'valid'} {'scenario' if kind == SCENARIO else 'experiment'}")
    return 1 if invalid else 0


def find_files(path: Path) -> list[tuple[Path, str]]:
    """Returns scenarios and experiments with their kinds: those in a folder, or the given file."""
    if path.is_dir():
        found = []
        for file in sorted(path.glob("*.json")):
            if (kind := _kind(file)) is not None:
                found.append((file, kind))
            else:
                print(f"{file}: skipped, because it has neither the key '{SCENARIO}' nor '{EXPERIMENT}'", file=sys.stderr)
        if not found:
            raise Failure(f"'{path}' contains no scenarios or experiments; name a folder with scenario files")
        return found
    # The player reports the error in any other file.
    return [(path, _kind(path) or SCENARIO)]


def _kind(file: Path) -> str | None:
    """Returns the kind of a file by its keys, without parsing it, because the file may be invalid."""
    # Reading a pipe or a device might never end.
    if not file.is_file():
        return None
    try:
        text = file.read_text(encoding="utf-8", errors="replace")
    except OSError:
        # The player reports the error.
        return SCENARIO
    # Comments may contain the keys, and strings may contain the beginning of a comment.
    text = re.sub(r'("(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\')|//[^\n]*|/\*.*?\*/', r"\1", text, flags=re.DOTALL)
    top, nested = text.partition("{")[2], 1
    while nested:
        top, nested = re.subn(r"\{[^{}]*\}", "", top)
    # Nested objects may contain the same keys. If their brackets do not match, the whole file is searched. Keys may have single quotes or none.
    return next((key for part in (top, text) for key in (EXPERIMENT, SCENARIO) if re.search(rf"""(?m)("|(^|[{{,])\s*'?){key}["']?\s*:""", part)), None)


def _check_scenario(file: Path, trust: list[str]) -> bool:
    try:
        plan = player.plan(str(file), trust)
        jar, dll = plan.programs_jar(), plan.scripts_dll()
        with tempfile.TemporaryDirectory(prefix="collektive-") as out:
            return _is_valid(player.run(str(file), plan, jar, dll, find_jdk(), ["--out", os.path.realpath(out), "--check", *trust]))
    except Failure as failure:
        if str(failure):
            print(f"collektive: {failure}", file=sys.stderr)
        return False


def _check_experiment(file: Path, trust: list[str]) -> bool:
    # The command takes the lock itself.
    lock.release()
    return _is_valid(processes.call([COLLEKTIVE, "sweep", "--dry-run", *trust, "--", file]))


def _is_valid(code: int) -> bool:
    """Evaluates the exit code of a check. Raises `KeyboardInterrupt` if a signal ended the check."""
    if code in (128 + signal.SIGINT, 128 + signal.SIGTERM):
        raise KeyboardInterrupt
    return code == 0
