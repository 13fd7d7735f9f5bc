"""Replays a recorded run without Unity and compares the digest of each tick with the record. With --programs, runs other programs on the recorded
input and reports where the answers differ. To record a run, set "outputs": { "record": true } in the scenario, or Record in the Simulation
Manager.

With --runtime, replays on the other runtime. Programs must be compiled for that runtime: pass a jar, or a folder of Kotlin and its --schema. For
collektive, also pass --runtime-jars, and --runtime-plugin to compile a folder.

Exit code: 0 all digests are equal; 1 a digest differs; 2 the record or a jar is unusable or truncated."""
import argparse
import os
from pathlib import Path

from build import graph, inputs, outputs, projects, records
from build.console import Failure
from build.places import SAMPLES_JAR


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("record", metavar="FILE")
    parser.add_argument("--trust", action="store_true",
                        help="run programs that ./collektive run has not run before, such as those in a record from someone else; they run with your rights")
    parser.add_argument("--programs", type=Path, action="append", default=[], metavar="JAR|DIR", help="run these programs instead of the recorded ones")
    parser.add_argument("--schema", type=Path, metavar="SCHEMA.fbs", help="schema of a folder of programs")
    parser.add_argument("--runtime", metavar="NAME", help="builtIn or collektive (default: the record's)")
    parser.add_argument("--runtime-jars", metavar="DIR", help="folder with Collektive's jars")
    parser.add_argument("--runtime-plugin", type=Path, metavar="JAR", help="Collektive's compiler plugin")
    parser.add_argument("--out", metavar="RECORD", help="record the replay, for ./collektive diff")
    parser.set_defaults(error_code=records.UNUSABLE)


def run(arguments: argparse.Namespace) -> int:
    if arguments.out is not None:
        if os.path.exists(arguments.out) and os.path.exists(arguments.record) and os.path.samefile(arguments.out, arguments.record):
            raise Failure(f"replay: --out '{arguments.out}' is the record that is read: name another file")
        place = Path(os.path.realpath(arguments.out))
        if place.name == "run.clkrec" and outputs.is_of_run(place.parent):
            raise Failure(f"replay: --out '{arguments.out}' is reserved for the record of the run in that folder: name another file")
        outputs.require_replaceable(arguments.out, b"CLKREC", "--out")
    for programs in arguments.programs:
        # Reading a pipe or a device might never end.
        if programs.exists() and not programs.is_file() and not programs.is_dir():
            raise Failure(f"replay: --programs '{programs}' is not a jar or folder")
    graph.build("jvm")
    # The samples' programs may have run in Unity.
    projects.record_own_program(SAMPLES_JAR)
    jars = arguments.runtime_jars and os.path.realpath(arguments.runtime_jars)
    words: list[str | Path] = ["--trust"] if arguments.trust else []
    for programs in arguments.programs:
        words += ["--programs", _compiled(programs, jars, arguments) if programs.is_dir() else programs]
    for option, value in {"--runtime": arguments.runtime, "--runtime-jars": jars, "--out": arguments.out}.items():
        if value is not None:
            words += [option, value]
    return records.read("replay", arguments.record, *words, "--own", projects.OWN_PROGRAMS)


def _compiled(programs: Path, jars: str | None, arguments: argparse.Namespace) -> Path:
    """Returns the jar of a folder of programs."""
    if arguments.schema is None or not arguments.schema.is_file():
        raise Failure(f"replay: --programs '{programs}' is a folder: name its schema with --schema")
    parts = [inputs.schema(arguments.schema), inputs.programs(programs)]
    if arguments.runtime == "collektive" and jars is not None:
        plugin: Path | None = arguments.runtime_plugin
        if plugin is None or not plugin.is_file():
            raise Failure("replay: compiling programs for collektive needs its compiler plugin: name the plugin with --runtime-plugin")
        parts += [inputs.jars(Path(jars)), inputs.jar(plugin)]
    return projects.programs_jar(*parts)
