"""The commands ./collektive sweep and plot."""
import argparse
import os
import sys

from . import experiment as experiments
from .positions import ExperimentError
from .sweep import sweep


def main(words: list[str]) -> int:
    """Runs a command; returns the exit code."""
    parser = argparse.ArgumentParser(prog="./collektive")
    commands = parser.add_subparsers(dest="command", required=True)
    sweeping = commands.add_parser("sweep")
    sweeping.add_argument("experiment")
    sweeping.add_argument("--out")
    sweeping.add_argument("--jobs", type=_positive, default=len(os.sched_getaffinity(0)))
    sweeping.add_argument("--time-limit", type=_positive, default=3600)
    for flag in ("--resume", "--csv", "--dry-run", "--trust-jvm"):
        sweeping.add_argument(flag, action="store_true")
    plotting = commands.add_parser("plot")
    plotting.add_argument("folder")
    options = parser.parse_args(words)
    try:
        return _plot(options) if options.command == "plot" else _sweep(options)
    except ExperimentError as error:
        print(f"collektive: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"collektive: a file could not be read or written: {error}", file=sys.stderr)
        return 1


def _sweep(options: argparse.Namespace) -> int:
    experiment = experiments.read(options.experiment)
    out = options.out or os.path.join("out", os.path.splitext(os.path.basename(options.experiment))[0])
    if options.dry_run:
        print(f"{experiment.count} runs into {out}, {options.jobs} at once")
        for _, run in zip(range(5), experiment.runs()):
            print("  " + run.name)
        if experiment.count > 5:
            print("  ...")
        return 0
    code = sweep(experiment, out, jobs=options.jobs, resume=options.resume, with_csv=options.csv, limit=options.time_limit, trust=options.trust_jvm)
    print(os.path.join(out, "runs.parquet"))
    print(os.path.join(out, "series.parquet"))
    return code


def _plot(options: argparse.Namespace) -> int:
    # Matplotlib takes half a second that sweeps need not wait for.
    from .figures import plot
    for path in plot(options.folder):
        print(path)
    return 0


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
