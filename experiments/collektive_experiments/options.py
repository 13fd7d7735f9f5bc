"""The options of a sweep: ./collektive reads this module by itself, without the package's dependencies."""
import argparse
import os


def add_sweep_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of ./collektive sweep."""
    parser.add_argument("experiment", metavar="EXPERIMENT.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/NAME)")
    parser.add_argument("--jobs", type=_positive, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="simultaneous runs (default: the number of processors)")
    parser.add_argument("--resume", action="store_true", help="continue a sweep that was stopped; complete runs are not repeated")
    parser.add_argument("--csv", action="store_true", help="write runs.csv and series.csv, too")
    parser.add_argument("--dry-run", action="store_true", help="print the number of runs and about how long they take, from a trial of two of them")
    parser.add_argument("--keep-going", action="store_true", help="continue even if the first runs all fail in the same way")
    parser.add_argument("--time-limit", type=_positive, default=3600, metavar="SECONDS", help="seconds after which a run is ended (default: 3600)")
    parser.add_argument("--trust-jvm", action="store_true", help="as for ./collektive run")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--ray", metavar="ADDRESS", help="run on the Ray cluster at ADDRESS; auto: the local one, started for the sweep if none runs")
    where.add_argument("--slurm", action="store_true", help="run nothing, but write an array job for the runs that are not done, slurm.sh")


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number above 0")
    return int(text)
