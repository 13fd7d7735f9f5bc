"""Compares two recorded runs. Prints the first tick, node and field that differ, first in the input, then in the results. Does not run the
recorded programs.

Exit code: 0 the runs are equal; 1 they differ; 2 a record is unusable or truncated."""
import argparse

from build import graph, records


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("a", metavar="A")
    parser.add_argument("b", metavar="B")
    parser.set_defaults(error_code=records.UNUSABLE)


def run(arguments: argparse.Namespace) -> int:
    graph.build("jvm")
    return records.read("diff", arguments.a, arguments.b)
