"""Names the first tick, node and field in which two recorded runs differ: the input first, then the results. No code of the records runs.

Exit code: 0 nothing differs; 1 something does; 2 a record cannot be used, or not to its end."""
import argparse

from build import graph, records


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("a", metavar="A")
    parser.add_argument("b", metavar="B")
    parser.set_defaults(error_code=records.UNUSABLE)


def run(arguments: argparse.Namespace) -> int:
    graph.build("jvm")
    return records.read("diff", arguments.a, arguments.b)
