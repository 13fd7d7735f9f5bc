"""Measures what rounds and ticks cost, prints a table and writes it as JSON. Times of a busy machine mean little."""
import argparse
import subprocess
from pathlib import Path

from build import bench_scene, graph, managed, processes
from build.console import say
from build.jdk import find_jdk
from build.places import BENCH_JAR, BUILD, CSHARP, HOST_JAR, LIBRARY_JAR, SAMPLES_JAR

BENCH = BUILD / "bench"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    kinds = parser.add_subparsers(metavar="KIND", required=True)
    rounds = kinds.add_parser("rounds", help="a round of aggregate programs on the engine", allow_abbrev=False, description=_rounds.__doc__)
    tick = kinds.add_parser("tick", help="a tick without a scene", allow_abbrev=False, description=_tick.__doc__)
    scene = kinds.add_parser("scene", help="a whole tick of a scene", allow_abbrev=False, description=_scene.__doc__)
    for kind, function in ((rounds, _rounds), (tick, _tick), (scene, _scene)):
        kind.add_argument("--quick", action="store_true", help="measure for less time")
        kind.set_defaults(measure=function)
    tick.add_argument("--nodes", metavar="N,N...", help="numbers of nodes")
    scene.add_argument("--nodes", type=bench_scene.sizes_of, default=bench_scene.NODES, metavar="N,N...", help="numbers of nodes")
    for kind, name in ((tick, "tick"), (scene, "scene")):
        kind.add_argument("--out", type=Path, default=BENCH / f"{name}.json", metavar="FILE", help=f"file for the results (default: build/bench/{name}.json)")


def run(arguments: argparse.Namespace) -> int:
    return int(arguments.measure(arguments))


def _rounds(arguments: argparse.Namespace) -> int:
    """Measures what a round of aggregate programs costs on the engine, time and garbage, beside plain loops, with JMH. Writes
    build/bench/rounds.json. About eight minutes, three with --quick."""
    graph.build("jvm", "jvm_modules")
    out = BENCH / "rounds.json"
    BENCH.mkdir(parents=True, exist_ok=True)
    java = find_jdk() / "bin/java"
    # JMH uses what newer JVMs warn of, in each process that it starts.
    quiet = ["--sun-misc-unsafe-memory-access=allow"]
    if subprocess.run([java, *quiet, "-version"], capture_output=True).returncode != 0:
        quiet = []
    libraries = f"{BENCH_JAR}:{BENCH_JAR.parent}/lib/*:{HOST_JAR}:{LIBRARY_JAR}:{SAMPLES_JAR}"
    words = ["--quick"] if arguments.quick else []
    return _wrote(out, processes.call([java, *quiet, "-cp", libraries, "org.collektive.bench.rounds.RoundsKt", out, *words]))


def _tick(arguments: argparse.Namespace) -> int:
    """Measures what a tick costs, all in one run and in turn: in-process (this product), the same shim with a call for each node, the same frames
    over a TCP socket, the rounds without the boundary, plain loops; then an empty tick and the addition of nodes. Prints what is promised, too.
    --quick takes under two minutes on two idle cores; without it there are more ticks and a run of 20,000 (pauses, memory)."""
    graph.build("runtime", "jvm_modules", "Collektive.Headless.Bench.exe")
    words = ["--quick"] if arguments.quick else []
    if arguments.nodes is not None:
        words += ["--nodes", arguments.nodes]
    command = managed.command("mono-sgen", CSHARP / "Collektive.Headless.Bench.exe", "--java-home", find_jdk(), "--host-jar", HOST_JAR,
                              "--jar", SAMPLES_JAR, "--jar", BENCH_JAR, "--out", arguments.out, *words)
    return _wrote(arguments.out, processes.call(command, env=managed.environment("mono-sgen")))


def _scene(arguments: argparse.Namespace) -> int:
    """Measures what whole ticks of a scene cost, physics included: the case study with 500 to 50,000 bodies, each size in a process of its own, on a
    field that grows with the swarm. Prints the phases of a tick, memory, and the growth of a node's cost over that of the first size. About two
    minutes on two idle cores; --quick measures half as long."""
    bench_scene.measure(arguments.out, arguments.quick, arguments.nodes)
    return _wrote(arguments.out, 0)


def _wrote(out: Path, code: int) -> int:
    if code == 0:
        say(f"wrote {out}")
    return code
