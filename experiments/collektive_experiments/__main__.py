"""Implements the commands ./collektive sweep, tune and plot."""
import argparse
import os
import re
import signal
import sys
from types import FrameType
from typing import NoReturn

from . import experiment as experiments
from . import figure_options
from .options import add_plot_arguments, add_sweep_arguments, add_tune_arguments
from .positions import ExperimentError
from .search import check_search, read_search
from .slurm import run_task, write_job
from .store import Store
from .sweep import LocalPool, Pool, begin, duration, estimate, sweep
from .worker import WorkerError


class Parser(argparse.ArgumentParser):
    """A parser that reports errors in the same way as the other commands."""

    def error(self, message: str) -> NoReturn:
        """Ends the program."""
        command = self.prog.split()[-1]
        print(f"collektive: {command}: {message} (see ./collektive {command} --help)", file=sys.stderr)
        sys.exit(1)


def main(words: list[str]) -> int:
    """Runs a command and returns the exit code."""
    parser = Parser(prog="./collektive")
    commands = parser.add_subparsers(dest="command", required=True)
    sweeping = commands.add_parser("sweep")
    add_sweep_arguments(sweeping)
    add_tune_arguments(commands.add_parser("tune"))
    task = commands.add_parser("task")
    task.add_argument("folder")
    task.add_argument("index", type=int)
    plotting = commands.add_parser("plot")
    add_plot_arguments(plotting)
    options = parser.parse_args(words)
    try:
        # `./collektive` blocks this signal during imports.
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        if options.command == "plot":
            return _plot(options)
        if options.command == "task":
            return run_task(options.folder, options.index)
        return _tune(options) if options.command == "tune" else _sweep(options)
    except (ExperimentError, WorkerError) as error:
        print(f"collektive: {_line(str(error))}", file=sys.stderr)
        return 1
    except KeyboardInterrupt as error:
        print("collektive: interrupted", file=sys.stderr)
        return 128 + (error.args or (signal.SIGINT,))[0]
    except OSError as error:
        print(f"collektive: a file could not be read or written: {_line(str(error))}", file=sys.stderr)
        return 1


def _sweep(options: argparse.Namespace) -> int:
    experiment = experiments.read(options.experiment)
    out = options.out or os.path.join("out", os.path.splitext(os.path.basename(options.experiment))[0])
    if options.dry_run:
        checks = []
        if "tune" in experiment.located.root:
            search = read_search(experiment)
            checks.append(lambda store: check_search(experiment, search, store, options.trust_jvm))
        seconds = estimate(experiment, options.jobs, options.time_limit, options.trust_jvm, *checks)
        print(f"{experiment.count} runs into {out}, {options.jobs} at once, about {duration(seconds)}")
        for _, run in zip(range(5), experiment.runs()):
            print("  " + run.name)
        if experiment.count > 5:
            print("  ...")
        return 0
    with Store(out) as store:
        todo = begin(experiment, store, options.resume, options.trust_jvm)
        if options.slurm and todo:
            print(write_job(store, todo, _threads(experiment), options.time_limit, options.trust_jvm))
            return 0
        code = sweep(experiment, store, todo, _pool(options, store), options.jobs, options.csv, options.keep_going)
    print("\n".join(path for name in ("runs", "series", "nodes") if os.path.exists(path := os.path.join(out, f"{name}.parquet"))))
    return code


def _tune(options: argparse.Namespace) -> int:
    # This import is here because Optuna is downloaded only for this command.
    from .tune import tune
    experiment = experiments.read(options.experiment)
    search = read_search(experiment)
    out = options.out or os.path.join("out", os.path.splitext(os.path.basename(options.experiment))[0] + "-tuned")
    with Store(out) as store:
        return tune(experiment, search, store, lambda: _pool(options, store), options)


def _pool(options: argparse.Namespace, store: Store) -> Pool:
    if options.ray is None:
        return LocalPool(store, options.jobs, options.time_limit, options.trust_jvm)
    # This import is here because Ray is downloaded only for this option.
    from .cluster import RayPool
    return RayPool(store, options.ray, options.time_limit, options.trust_jvm)


def _threads(experiment: experiments.Experiment) -> int:
    """Returns the largest number of threads that a run uses."""
    threads = experiment.scenario.root.get("threads", 1)
    return int(max(run.settings.get("threads", threads) for run in experiment.runs()))


def _line(message: str) -> str:
    """Converts a message to one line, and escapes its control characters."""
    return re.sub(r"[\x00-\x1f\x7f\u2028\u2029]", lambda found: repr(found[0])[1:-1], message)


def _terminate(number: int, _: FrameType | None) -> NoReturn:
    """Ends the program like Ctrl-C, which removes temporary files. A second signal does not interrupt this."""
    signal.signal(number, signal.SIG_IGN)
    raise KeyboardInterrupt(number)


def _plot(options: argparse.Namespace) -> int:
    # This import is here because importing Matplotlib takes half a second.
    from .figures import plot
    given = {option: value for option in figure_options.KEYS if (value := getattr(options, option)) is not None}
    requested = figure_options.read_options(given, lambda option, problem: ExperimentError(f"plot: --{option} {problem}")) if given else None
    experiment = experiments.read(options.experiment) if options.experiment else None
    for path in plot(options.folder, options=requested, experiment=experiment):
        print(path)
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, _terminate)
    sys.exit(main(sys.argv[1:]))
