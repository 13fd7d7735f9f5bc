"""Defines the options of ./collektive sweep, tune and plot. This module has no dependencies, because ./collektive loads it without the package."""
import argparse
import os
import re
from collections.abc import Callable

MAX_JOBS = 10_000
MAX_NUMBER = 10 ** 9
"""The maximum number of trials and seconds. Python cannot wait longer than about 9 * 10^9 seconds."""


def add_sweep_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of ./collektive sweep."""
    group = _add_run_arguments(parser, "out/NAME")
    group.add_argument("--slurm", action="store_true", help="write slurm.sh, an array job for the remaining runs, instead of running them")
    parser.add_argument("--resume", action="store_true", help="continue a sweep that was stopped; complete runs are not repeated")
    parser.add_argument("--csv", action="store_true", help="also write the tables as CSV files")
    parser.add_argument("--dry-run", action="store_true", help="make three trial runs, and print the number of runs and their estimated time")


def add_tune_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of ./collektive tune."""
    _add_run_arguments(parser, "out/NAME-tuned")
    parser.add_argument("--trials", type=_up_to(MAX_NUMBER), metavar="N", help="total number of trials (default: the number in the experiment file, or 50)")
    parser.add_argument("--resume", action="store_true", help="continue a search; complete runs are not repeated")


def _add_run_arguments(parser: argparse.ArgumentParser, out: str) -> "argparse._MutuallyExclusiveGroup":
    """Adds the arguments of commands that execute runs. Returns the group of options that select other machines."""
    parser.add_argument("experiment", metavar="EXPERIMENT.json")
    parser.add_argument("--out", metavar="DIR", help=f"folder for the results (default: {out})")
    parser.add_argument("--jobs", type=_up_to(MAX_JOBS), default=len(os.sched_getaffinity(0)), metavar="N",
                        help="simultaneous runs (default: the number of processors)")
    parser.add_argument("--time-limit", type=_up_to(MAX_NUMBER), default=3600, metavar="SECONDS", help="stop a run after this many seconds (default: 3600)")
    parser.add_argument("--trust-jvm", action="store_true", help="see ./collektive run --help")
    parser.add_argument("--keep-going", action="store_true", help="continue even if the first runs all fail in the same way")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--ray", metavar="ADDRESS", help="run on the Ray cluster at ADDRESS; auto uses the local cluster, and starts one if none is running")
    return group


def add_plot_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of ./collektive plot. The package checks their values, because experiment files can contain them, too."""
    parser.add_argument("folder", metavar="FOLDER", help="folder of a sweep")
    parser.add_argument("--metric", action="extend", nargs="+", metavar="NAME", help="draw only one figure of each of these metrics")
    parser.add_argument("--x", metavar="KEY", help="key of the horizontal axis, or time (default for the kind line: time)")
    parser.add_argument("--by", metavar="KEY", help="key shown by colours, markers and line styles, or by the vertical axis of a heat map")
    parser.add_argument("--kind", metavar="line|box|heat|ecdf", help="kind of figure (default: line)")
    parser.add_argument("--log", metavar="x|y|xy", help="axes with a logarithmic scale")
    # Without this pattern, argparse would read a range such as -1:1 as an unknown option.
    parser._negative_number_matcher = re.compile(r"-[0-9.]")
    parser.add_argument("--range", metavar="A:B", help="limits of the metric's axis")
    parser.add_argument("--size", metavar="WxH", help="width and height in inches (default: the width of a column, and a height of 2.2)")
    parser.add_argument("--style", metavar="plain|ieee|acm", help="fonts and axes (default: plain)")
    parser.add_argument("--experiment", metavar="EXPERIMENT.json", help="use the figures and labels of this file instead of those during the sweep")


def _up_to(maximum: int) -> Callable[[str], int]:
    """Returns a function that reads a whole number from 1 to `maximum`."""
    def read(text: str) -> int:
        if not re.fullmatch("[0-9]{1,20}", text) or not 1 <= int(text) <= maximum:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from 1 to {maximum:,}")
        return int(text)

    return read
