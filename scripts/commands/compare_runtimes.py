"""Runs Kotlin functions on random networks, on the built-in runtime and on Collektive, and prints the smallest run in which their answers differ.

PROGRAM is a Kotlin file, or a folder of Kotlin. Its public top-level functions with the receiver Aggregate<Int>, and with no parameter or a Device,
are compared. Decimal numbers that differ by at most a billionth of their size count as equal. Networks are lines, grids and random geometric graphs,
some with nodes that move, leave and join, and some that lose messages.

COLLEKTIVE_JARS names the folder of Collektive's jars; its compiler plugin is in or beside that folder. Without COLLEKTIVE_JARS, the built-in
runtime is compared with its own implementation of Collektive's public API, which passes messages through mailboxes.

Exit code: 0 no difference; 1 a difference; 2 the programs cannot be compared."""
import argparse
import os
import random
import re
import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from build import graph, inputs, projects
from build.console import Failure
from build.jdk import environment, find_jdk
from build.places import ADAPTER_JAR, HOST_JAR, LIBRARY_JAR, TESTING_JAR, compiler_plugin

SCHEMA = Path(__file__).with_suffix(".fbs")
NUMBER = re.compile(r"-?\d+\.\d+(?:E-?\d+)?")
# Collektive computes distances by another formula, so the last digits differ.
TOLERANCE = 1e-9


@dataclass(frozen=True)
class Tick:
    """The network during one tick, and the nodes that run a round."""
    nodes: tuple[int, ...]
    links: tuple[tuple[int, int], ...]
    due: tuple[int, ...]

    def without_node(self, node: int) -> "Tick":
        kept = tuple(link for link in self.links if node not in link)
        return Tick(tuple(n for n in self.nodes if n != node), kept, tuple(n for n in self.due if n != node))

    def __str__(self) -> str:
        return f"{_joined(self.nodes)}|{_joined(f'{a}-{b}' for a, b in self.links)}|{_joined(self.due)}"


@dataclass(frozen=True)
class Run:
    """A network over time. `loss` is the probability that a message is lost."""
    title: str
    seed: int
    loss: float
    ticks: tuple[Tick, ...]


@dataclass(frozen=True)
class Difference:
    """The first round with different answers."""
    tick: int
    node: int
    answers: tuple[str, str]


class RuntimeProcess:
    """A JVM that runs the functions of a jar on one runtime."""

    def __init__(self, runtime: str, programs: Path, jars: list[Path]) -> None:
        path = ":".join(str(jar) for jar in [HOST_JAR, TESTING_JAR, *jars, programs])
        command: list[str | Path] = [find_jdk() / "bin/java", "-XX:+UseSerialGC", "-Dfile.encoding=UTF-8", "-cp", path]
        command += ["org.collektive.testing.ComparedRunsKt", programs, runtime]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8", env=environment())
        self.functions = self._lines()

    def __enter__(self) -> "RuntimeProcess":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.communicate()

    def answers(self, function: str, run: Run) -> list[str]:
        """Runs the function on the networks of `run` and returns a line `TICK NODE ANSWER` for each round."""
        assert self._process.stdin is not None
        self._process.stdin.write("".join(f"{line}\n" for line in [f"{run.seed} {run.loss} {function}", *run.ticks, ""]))
        self._process.stdin.flush()
        return self._lines()

    def _lines(self) -> list[str]:
        assert self._process.stdout is not None
        lines = []
        while (line := self._process.stdout.readline()) != "\n":
            if not line:
                raise Failure("compare-runtimes: a JVM has ended; its messages are above")
            lines.append(line[:-1])
        return lines


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("programs", type=Path, nargs="+", metavar="PROGRAM")
    parser.add_argument("--function", action="append", default=[], metavar="NAME", help="compare only these functions")
    parser.add_argument("--runs", type=int, default=60, metavar="N", help="networks for each function (default: 60)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="seed of the networks (default: 1)")
    parser.set_defaults(error_code=2)


def run(arguments: argparse.Namespace) -> int:
    if arguments.runs < 1:
        raise Failure(f"compare-runtimes: --runs is {arguments.runs}; use at least 1")
    graph.build("jvm", "jvm_modules")
    code = 0
    for programs in arguments.programs:
        with ExitStack() as stack:
            processes = _start(programs, stack)
            functions = processes[0].functions
            unknown = [name for name in arguments.function if name not in functions]
            if unknown or not functions:
                raise Failure(f"compare-runtimes: '{programs}' has no public function `fun Aggregate<Int>.{unknown[0] if unknown else 'NAME'}()`, with or "
                              f"without a parameter of type Device{'; it has ' + ', '.join(functions) if functions else ''}")
            repeated = next((name for name in functions if functions.count(name) > 1), None)
            if repeated:
                raise Failure(f"compare-runtimes: '{programs}' has several functions '{repeated}'; give each a different name")
            for function in arguments.function or functions:
                code |= _compare(function, processes, _runs(arguments.seed, arguments.runs))
    return code


def _start(programs: Path, stack: ExitStack) -> tuple[RuntimeProcess, RuntimeProcess]:
    # Reading a pipe or a device might never end.
    if not programs.is_file() and not programs.is_dir():
        raise Failure(f"compare-runtimes: '{programs}' {'is not a file or folder' if programs.exists() else 'does not exist'}")
    source = inputs.programs(programs) if programs.is_dir() else inputs.Part(programs.parent, lambda folder: {programs.name: folder / programs.name})
    schema = inputs.schema(SCHEMA)
    jar = projects.programs_jar(schema, source)
    built_in = stack.enter_context(RuntimeProcess("builtIn", jar, [LIBRARY_JAR]))
    folder = os.environ.get("COLLEKTIVE_JARS")
    if not folder:
        return built_in, stack.enter_context(RuntimeProcess("collektive", jar, [LIBRARY_JAR, ADAPTER_JAR]))
    place = Path(folder)
    plugin = next((jar for near in (place, place.parent) for jar in sorted(near.glob("*compiler-plugin*.jar"))), compiler_plugin())
    jars = inputs.jars(place)
    if not jars.files:
        raise Failure(f"compare-runtimes: COLLEKTIVE_JARS names '{folder}', which contains no jars; name the folder of collektive-dsl, collektive-stdlib "
                      "and their dependencies")
    other = projects.programs_jar(schema, source, jars, inputs.jar(plugin))
    return built_in, stack.enter_context(RuntimeProcess("collektive", other, [ADAPTER_JAR, *jars.files.values()]))


def _compare(function: str, processes: tuple[RuntimeProcess, RuntimeProcess], runs: Iterator[Run]) -> int:
    """Compares a function on all runs until the first difference, which it prints. Returns 1 if there is one."""
    count = rounds = 0
    for candidate in runs:
        found = _difference(function, processes, candidate)
        count += 1
        rounds += sum(len(tick.due) for tick in candidate.ticks)
        if found is not None:
            smallest = _shrink(candidate, lambda smaller: _difference(function, processes, smaller))
            _print(function, smallest, _difference(function, processes, smallest) or found)
            return 1
    print(f"{function}: no difference in {count} runs, {rounds} rounds")
    return 0


def _difference(function: str, processes: tuple[RuntimeProcess, RuntimeProcess], candidate: Run) -> Difference | None:
    for built_in, other in zip(*(side.answers(function, candidate) for side in processes), strict=True):
        if not _same(built_in, other):
            tick, node, answer = built_in.split(" ", 2)
            return Difference(int(tick), int(node), (answer, other.split(" ", 2)[2]))
    return None


def _same(a: str, b: str) -> bool:
    # Texts, which have quotes, must be equal.
    if a == b or a.endswith('"') or NUMBER.split(a) != NUMBER.split(b):
        return a == b
    pairs = zip(map(float, NUMBER.findall(a)), map(float, NUMBER.findall(b)), strict=True)
    return all(abs(x - y) <= TOLERANCE * max(abs(x), abs(y)) for x, y in pairs)


def _shrink(candidate: Run, difference: Callable[[Run], Difference | None]) -> Run:
    """Removes ticks, nodes, links and rounds as long as a difference remains."""
    found = difference(candidate)
    while found is not None:
        candidate = replace(candidate, ticks=candidate.ticks[:found.tick])
        found = None
        for smaller in _smaller(candidate):
            found = difference(smaller)
            if found is not None:
                candidate = smaller
                break
    return candidate


def _smaller(candidate: Run) -> Iterator[Run]:
    ticks = candidate.ticks
    if candidate.loss > 0:
        yield replace(candidate, loss=0.0)
    for index in range(len(ticks)):
        yield replace(candidate, ticks=ticks[:index] + ticks[index + 1:])
    for node in sorted({node for tick in ticks for node in tick.nodes}):
        yield replace(candidate, ticks=tuple(tick.without_node(node) for tick in ticks))
    for link in sorted({link for tick in ticks for link in tick.links}):
        yield replace(candidate, ticks=tuple(replace(tick, links=tuple(other for other in tick.links if other != link)) for tick in ticks))
    for index, tick in enumerate(ticks):
        for node in tick.due:
            fewer = replace(tick, due=tuple(other for other in tick.due if other != node))
            yield replace(candidate, ticks=(*ticks[:index], fewer, *ticks[index + 1:]))


def _print(function: str, smallest: Run, found: Difference) -> None:
    nodes = {node for tick in smallest.ticks for node in tick.nodes}
    print(f"{function} differs; the smallest run has {len(nodes)} nodes and {len(smallest.ticks)} ticks "
          f"({smallest.title}, seed {smallest.seed}, loss {smallest.loss}):")
    for number, tick in enumerate(smallest.ticks, 1):
        links = _joined(f"{a}-{b}" for a, b in tick.links) or "none"
        print(f"  tick {number}: nodes {_joined(tick.nodes)}; links {links}; rounds of {_joined(tick.due) or 'none'}")
    other = "Collektive" if os.environ.get("COLLEKTIVE_JARS") else "the mailbox runtime"
    print(f"  tick {found.tick}, node {found.node}: {found.answers[0]} on the built-in runtime, {found.answers[1]} on {other}")


def _runs(seed: int, count: int) -> Iterator[Run]:
    for index in range(count):
        rng = random.Random(f"{seed} {index}")
        topology, churns = ("line", "grid", "geometric")[index % 3], index % 2 == 1
        yield Run(f"{topology}{' with churn' if churns else ''}", index + 1, 0.2 if index % 4 == 3 else 0.0, tuple(_ticks(rng, topology, churns)))


def _ticks(rng: random.Random, topology: str, churns: bool) -> Iterator[Tick]:
    size = rng.randint(2, 12)
    places = {node: _place(rng, topology, node) for node in range(size)}
    for _ in range(rng.randint(4, 20)):
        if churns:
            for node in [node for node in places if rng.random() < 0.1]:
                del places[node]
            for node in range(size + 2):
                if node not in places and rng.random() < 0.3:
                    places[node] = _place(rng, topology, node)
            for node in [node for node in places if rng.random() < 0.1]:
                x, y = places[node]
                places[node] = x + rng.uniform(-1, 1), y + rng.uniform(-1, 1)
        nodes = tuple(sorted(places))
        links = tuple((a, b) for a in nodes for b in nodes if a < b and _are_near(places[a], places[b]))
        yield Tick(nodes, links, tuple(node for node in nodes if not churns or rng.random() < 0.7))


def _place(rng: random.Random, topology: str, node: int) -> tuple[float, float]:
    if topology == "line":
        return float(node), 0.0
    return (float(node % 4), float(node // 4)) if topology == "grid" else (rng.uniform(0, 4), rng.uniform(0, 4))


def _are_near(a: tuple[float, float], b: tuple[float, float]) -> bool:
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 <= 1.5 ** 2


def _joined(parts: "Iterator[object] | tuple[object, ...]") -> str:
    return " ".join(map(str, parts))
