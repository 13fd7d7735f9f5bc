"""Runs benchmarks, prints a table and writes it as JSON. Times measured on a busy machine are not reliable."""
import argparse
import os
import subprocess
import tempfile
from pathlib import Path

from build import bench_scene, graph, managed, outputs, processes
from build.console import print_progress
from build.jdk import find_jdk
from build.places import BENCH_JAR, BUILD, CSHARP, HOST_JAR, LIBRARY_JAR, SAMPLES_JAR

BENCH = BUILD / "bench"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    kinds = parser.add_subparsers(metavar="KIND", required=True)
    rounds = kinds.add_parser("rounds", help="time and garbage of a round", allow_abbrev=False, description=_rounds.__doc__)
    tick = kinds.add_parser("tick", help="time of a tick without a scene", allow_abbrev=False, description=_tick.__doc__)
    scene = kinds.add_parser("scene", help="time of a whole tick of a scene", allow_abbrev=False, description=_scene.__doc__)
    for kind, function in ((rounds, _rounds), (tick, _tick), (scene, _scene)):
        kind.add_argument("--quick", action="store_true", help="measure for less time")
        kind.set_defaults(measure=function)
    tick.add_argument("--nodes", metavar="N,N...", help="numbers of nodes")
    scene.add_argument("--nodes", type=bench_scene.sizes_of, default=bench_scene.NODES, metavar="N,N...", help="numbers of nodes")
    for kind, name in ((tick, "tick"), (scene, "scene")):
        kind.add_argument("--out", type=Path, default=BENCH / f"{name}.json", metavar="FILE", help=f"file for the results (default: build/bench/{name}.json)")


def run(arguments: argparse.Namespace) -> int:
    if "out" not in arguments:
        return int(arguments.measure(arguments))
    out = Path(os.path.realpath(arguments.out))
    outputs.require_replaceable(str(out), b'{\n  "machine"', "--out")
    out.parent.mkdir(parents=True, exist_ok=True)
    # Earlier results are kept if the new ones cannot be written.
    with tempfile.TemporaryDirectory(prefix=f".{out.name}.", dir=out.parent) as work:
        arguments.out = Path(work, out.name)
        code = int(arguments.measure(arguments))
        if code == 0:
            arguments.out.replace(out)
    return _report_output(out, code)


def _rounds(arguments: argparse.Namespace) -> int:
    """Measures time and garbage of a round with JMH, in comparison with hand-written loops. Writes build/bench/rounds.json.
    Takes about eight minutes, or three with --quick."""
    graph.build("jvm", "jvm_modules")
    out = BENCH / "rounds.json"
    BENCH.mkdir(parents=True, exist_ok=True)
    java = find_jdk() / "bin/java"
    # JMH uses Unsafe in each process that it starts, and newer JVMs warn of that.
    quiet = ["--sun-misc-unsafe-memory-access=allow"]
    if subprocess.run([java, *quiet, "-version"], capture_output=True).returncode != 0:
        quiet = []
    libraries = f"{BENCH_JAR}:{BENCH_JAR.parent}/lib/*:{HOST_JAR}:{LIBRARY_JAR}:{SAMPLES_JAR}"
    words = ["--quick"] if arguments.quick else []
    return _report_output(out, processes.call([java, *quiet, "-cp", libraries, "org.collektive.bench.rounds.RoundsKt", out, *words]))


def _tick(arguments: argparse.Namespace) -> int:
    """Measures a tick in six variants in one run: in-process (this product), the JVM in a separate process, one call per node, frames over a TCP
    socket, rounds without the boundary, and hand-written loops. Also measures an empty tick and the addition of nodes, and prints the targets.
    --quick takes under two minutes on two idle cores. Without it, there are more ticks and a run of 20,000 ticks for pauses and memory."""
    graph.build("runtime", "jvm_modules", "Collektive.Headless.Bench.exe")
    words = ["--quick"] if arguments.quick else []
    if arguments.nodes is not None:
        words += ["--nodes", arguments.nodes]
    command = managed.command("mono-sgen", CSHARP / "Collektive.Headless.Bench.exe", "--java-home", find_jdk(), "--host-jar", HOST_JAR,
                              "--jar", SAMPLES_JAR, "--jar", BENCH_JAR, "--out", arguments.out, *words)
    return processes.call(command, env=managed.environment("mono-sgen"))


def _scene(arguments: argparse.Namespace) -> int:
    """Measures whole ticks of the case study, physics included, with 500 to 50,000 bodies on a field that grows with the swarm. Each size runs in
    its own process. Prints the 99th percentile and the phases of ticks, memory, the time per node relative to the first size, and the ratio of the
    phases to the same work as bare loops in C. Takes about three minutes on two idle cores, or half as long with --quick."""
    bench_scene.measure(arguments.out, arguments.quick, arguments.nodes)
    return 0


def _report_output(out: Path, code: int) -> int:
    if code == 0:
        print_progress(f"wrote {out}")
    return code
