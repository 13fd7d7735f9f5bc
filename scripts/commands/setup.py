"""Installs the build dependencies: system packages (as root on Debian or Ubuntu; otherwise lists the missing ones), flatc and the FlatBuffers
runtimes, PhysX for runs without Unity, and the C# compiler."""
import argparse

from build import fetch, graph, lock, platforms, system
from build.console import Failure, print_progress

TOOLS = [*fetch.FETCHERS, "nunit", "platforms"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("tools", nargs="*", metavar="TOOL", help="fetch only these tools: " + ", ".join(TOOLS))


def run(arguments: argparse.Namespace) -> int:
    for tool in arguments.tools:
        if tool not in TOOLS:
            raise Failure(f"setup: unknown tool '{tool}'; known: {', '.join(TOOLS)}")
    if not arguments.tools:
        graph.build("tools")
        print_progress("tools are ready")
        return 0
    system.setup_system()
    lock.shared()
    for tool in arguments.tools:
        if tool == "nunit":
            system.setup_nunit()
        elif tool == "platforms":
            platforms.setup_tests()
        else:
            fetch.fetch(tool)
    return 0
