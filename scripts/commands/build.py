"""Builds targets of the build graph, such as collektive_shim, jvm or csharp. CMakeLists.txt and cmake/ declare them."""
import argparse

from build import graph


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("targets", nargs="*", default=["runtime"], metavar="TARGET", help="targets (default: runtime, which is everything a scene needs)")


def run(arguments: argparse.Namespace) -> int:
    graph.build(*arguments.targets)
    return 0
