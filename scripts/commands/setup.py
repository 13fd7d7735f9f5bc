"""Installs missing system packages (as root on Debian or Ubuntu, else lists them), and fetches and builds the tools: flatc with the FlatBuffers
runtimes, PhysX for runs without Unity, the C# compiler."""
import argparse

from build import fetch, graph, lock, system
from build.console import say


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("tools", nargs="*", metavar="TOOL", help="fetch these tools of the build instead: " + ", ".join([*fetch.FETCHERS, "nunit"]))


def run(arguments: argparse.Namespace) -> int:
    if not arguments.tools:
        graph.build("tools")
        say("tools are ready")
        return 0
    system.setup_system()
    lock.shared()
    for tool in arguments.tools:
        if tool == "nunit":
            system.setup_nunit()
        else:
            fetch.fetch(tool)
    return 0
