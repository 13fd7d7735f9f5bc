"""Runs an experiment with local workers, and writes the tables."""
import math
import os
import queue
import re
import shutil
import signal
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Protocol

import pyarrow as pa

from . import tables
from .bundle import prepare
from .experiment import Experiment, Run, check_labels
from .figure_options import CONVERGED, check_metrics
from .positions import ExperimentError
from .store import Store
from .worker import Outcome, Worker, WorkerError

MIN_FREE_BYTES = 1 << 20
"""The number of bytes that must be free on the disk. The sweep stops after a failed run if fewer are free."""

REPEATED_SHARE = 0.02
MIN_REPEATED_RUNS = 3
"""The share and the minimum number of runs that are repeated in a fresh process, to check that results do not depend on earlier runs."""

MAX_EQUAL_FAILURES = 5
"""The number of runs after which the sweep stops if all of them have failed with the same message."""

Task = tuple[Run, bool]
"""A run, and whether it is repeated in a fresh process."""
Ended = tuple[Run, Outcome]


class SweepStopError(ExperimentError):
    """The results of the finished runs are a reason to stop the sweep."""


class Pool(Protocol):
    """A pool executes runs. It stores the results of each finished run, and adds the run to a queue."""

    def start(self, tasks: list[Task], ended: "queue.SimpleQueue[Ended | BaseException]") -> None:
        """Starts the runs in order."""

    def stop(self) -> None:
        """Cancels the current runs."""


class LocalPool:
    """A pool of workers on this machine, each with its own process."""

    def __init__(self, store: Store, jobs: int, limit: float, trust: bool):
        self._store = store
        self._limit = limit
        self._workers = [Worker(store.bundle, os.path.join(store.logs, f"worker-{index + 1}.txt"), trust) for index in range(jobs)]
        self._tasks: deque[Task] = deque()
        self._threads: list[threading.Thread] = []
        self._lock = threading.Lock()
        self._running: set[Worker] = set()
        self._stopped = False

    def start(self, tasks: list[Task], ended: "queue.SimpleQueue[Ended | BaseException]") -> None:
        """Starts the runs, grouped by JVM settings."""
        self._tasks.extend(sorted(tasks, key=lambda task: task[0].process))
        self._threads = [threading.Thread(target=self._work, args=(worker, ended)) for worker in self._workers]
        for thread in self._threads:
            thread.start()

    def stop(self) -> None:
        """Cancels the current runs and stops the workers."""
        with self._lock:
            self._stopped = True
            for worker in self._running:
                worker.kill()
        for thread in self._threads:
            thread.join()

    def _work(self, worker: Worker, ended: "queue.SimpleQueue[Ended | BaseException]") -> None:
        # While the results of a run are written to the disk, the worker executes the next run.
        writer = ThreadPoolExecutor(1)
        written: Future[None] | None = None
        try:
            while True:
                with self._lock:
                    if self._stopped or not self._tasks:
                        break
                    run, is_repeated = self._tasks.popleft()
                    self._running.add(worker)
                began = time.monotonic()
                outcome = worker.run(run.settings, run.process, self._store.begin(run), self._limit, is_repeated)
                with self._lock:
                    self._running.remove(worker)
                    if self._stopped:
                        break
                # At most one run waits until it is written.
                if written is not None:
                    written.result()
                written = writer.submit(self._finish, run, outcome, time.monotonic() - began, ended)
        except BaseException as error:
            ended.put(error)
        finally:
            worker.stop()
            writer.shutdown()

    def _finish(self, run: Run, outcome: Outcome, seconds: float, ended: "queue.SimpleQueue[Ended | BaseException]") -> None:
        try:
            self._store.finish(run, outcome, seconds)
            ended.put((run, outcome))
        except BaseException as error:
            ended.put(error)


def begin(experiment: Experiment, store: Store, resume: bool, trust: bool) -> list[Task]:
    """Creates or reopens the folder and the bundle, validates the keys, and returns the runs that are not complete."""
    store.open(experiment, resume)
    prepare(experiment.scenario, store.bundle, trust, experiment.runtimes)
    check_keys(experiment, store, trust)
    store.write_settings()
    todo: list[Run] = []
    for run in experiment.runs():
        if store.is_complete(run):
            tables.check_columns(store, run)
        else:
            todo.append(run)
    if len(todo) < experiment.count:
        print(f"collektive: {experiment.count - len(todo)} of {experiment.count} runs are already complete", file=sys.stderr)
    # Runs that gave different results are repeated again, because one execution of them could hide that.
    differing = {index for index, run in enumerate(todo) if (store.record(run) or {}).get("status") == "differs"}
    repeated = differing | set(_spread(len(todo)))
    return [(run, index in repeated) for index, run in enumerate(todo)]


def _spread(count: int) -> Iterable[int]:
    """Returns the indices of the runs that are repeated. They are evenly spread over all runs, and the last run is one of them."""
    size = min(count, max(MIN_REPEATED_RUNS, math.ceil(count * REPEATED_SHARE)))
    return ((index + 1) * count // size - 1 for index in range(size))


def sweep(experiment: Experiment, store: Store, todo: list[Task], pool: Pool, jobs: int, with_csv: bool, keep_going: bool = False) -> int:
    """Executes the remaining runs and writes the tables. If the first runs all fail in the same way, stops unless `keep_going` is true.

    Returns 0 if all runs are complete, 1 if some are not, and 128 plus the number of the signal if a signal interrupted the sweep.
    """
    try:
        code = drive(store, experiment.count, todo, pool, jobs, math.inf if keep_going else MAX_EQUAL_FAILURES)
    except SweepStopError:
        tables.write(experiment, store, with_csv)
        raise
    written = tables.write(experiment, store, with_csv)
    if code == 1:
        print("collektive: to repeat the incomplete runs, add --resume", file=sys.stderr)
    if code == 0 and written != experiment.count:
        raise ExperimentError(f"the tables have {written} of {experiment.count} runs: files in '{store.runs}' were changed; "
                              "repeat the missing runs with --resume")
    return code


def estimate(experiment: Experiment, jobs: int, limit: float, trust: bool, check: Callable[[Store], None] = lambda store: None) -> float:
    """Estimates the duration of the sweep in seconds. Executes the first run once and the middle run twice, all with one worker.

    Calls `check` before the first run.
    """
    runs = list(experiment.runs())
    with tempfile.TemporaryDirectory(prefix="collektive-") as folder, Store(os.path.join(folder, "out")) as store:
        begin(experiment, store, False, trust)
        check(store)
        worker = Worker(store.bundle, os.path.join(store.logs, "trial.txt"), trust)
        seconds = []
        try:
            for number, run in enumerate((runs[0], runs[len(runs) // 2], runs[len(runs) // 2])):
                began = time.monotonic()
                outcome = worker.run(run.settings, run.process, os.path.join(folder, str(number)), limit, is_repeated=False)
                seconds.append(time.monotonic() - began)
                if outcome.status != "complete":
                    raise ExperimentError(f"the time cannot be estimated: the trial run '{run.name}' failed ({outcome.status}: {outcome.message})")
        finally:
            worker.stop()
    return seconds[0] + seconds[2] * len(runs) / min(jobs, len(runs))


def drive(store: Store, total: int, todo: list[Task], pool: Pool, jobs: int, max_equal_failures: float) -> int:
    """Executes the runs of `todo`, which remain of `total` runs, and returns the exit code.

    Stops if the first `max_equal_failures` runs all fail in the same way.
    """
    ended: queue.SimpleQueue[Ended | BaseException] = queue.SimpleQueue()
    progress = Progress(total, total - len(todo), jobs)
    interrupted: list[int] = []
    handlers = {number: signal.signal(number, lambda number, frame: interrupted.append(number)) for number in (signal.SIGINT, signal.SIGTERM)}
    failed = 0
    messages: set[str] = set()
    try:
        pool.start(todo, ended)
        left = len(todo)
        while left and not interrupted:
            try:
                event = ended.get(timeout=0.2)
            except queue.Empty:
                progress.show()
                continue
            if isinstance(event, BaseException):
                raise event
            left -= 1
            run, outcome = event
            if outcome.status != "complete":
                failed += 1
                messages.add(outcome.message)
                progress.print(f"{run.name}: {outcome.status}: {outcome.message}")
                _require_room(store)
            progress.ended(outcome)
            if failed >= max_equal_failures and progress.done == total - len(todo) and len(messages) == 1:
                raise SweepStopError(f"the sweep stopped: its first {failed} runs all failed in the same way; correct the cause and continue with "
                              "--resume, or run all with --keep-going")
            if outcome.status == "differs":
                raise SweepStopError(f"the sweep stopped: two runs of '{run.name}' gave different results. The program or scene depends on more than its "
                              "inputs, such as a clock, a file or a random number without the scenario's seed")
    except (OSError, WorkerError) as error:
        raise ExperimentError(f"the sweep stopped: {error}; to continue, add --resume") from error
    finally:
        pool.stop()
        for number, handler in handlers.items():
            signal.signal(number, handler)
        progress.end()
    if interrupted:
        print(f"collektive: interrupted; {progress.done} of {total} runs are complete; to continue, add --resume", file=sys.stderr)
        return 128 + interrupted[0]
    if failed:
        print(f"collektive: {failed} of {total} runs are not complete", file=sys.stderr)
    return 1 if failed else 0


def _require_room(store: Store) -> None:
    if shutil.disk_usage(store.folder).free < MIN_FREE_BYTES:
        raise OSError(f"the disk of '{store.folder}' is full")


def check_keys(experiment: Experiment, store: Store, trust: bool, others: Iterable[tuple[dict[str, object], tuple[str | int, ...]]] = ()) -> list[str]:
    """Validates the values of all keys with the player, and returns the names of the metrics.

    Each value is combined with the first values of the other keys. Keys that vary together are validated row by row. Each entry of `others`, which has
    keys with values and a location for errors, is combined with the first values of the remaining keys.
    """
    worker = Worker(store.bundle, os.path.join(store.logs, "check.txt"), trust)
    located = experiment.located
    try:
        base = {key: values[0] for key, values in experiment.product + experiment.together}
        problem, metrics = worker.check(experiment.settings(base))
        if problem:
            raise located.error(problem, *_place(experiment, worker, problem))
        rows = [dict(zip([key for key, _ in experiment.together], row)) for row in zip(*(values for _, values in experiment.together))]
        candidates: Iterable[tuple[dict[str, object], tuple[str | int, ...]]] = [
            *(({key: value}, ("vary", key, index)) for key, values in experiment.product for index, value in _sample(values)),
            *((row, ("zip", experiment.together[0][0], index)) for index, row in _sample(rows)), *others]
        for values, place in candidates:
            problem, metrics = worker.check(experiment.settings({**base, **values}))
            if problem:
                raise located.error(problem, *place)
        for name in experiment.measure:
            if name not in metrics:
                raise located.error(f"the scene has no metric '{name}'; it has: {', '.join(metrics)}", "measure", name)
        _check_figures(experiment, list(experiment.measure or metrics))
        return metrics
    except WorkerError as error:
        raise ExperimentError(str(error)) from error
    finally:
        worker.stop()


def convergence_times(experiment: Experiment, others: Iterable[str] = ()) -> list[str]:
    """Returns the columns of convergence times, which the scenario, the experiment's keys or the keys `others` define."""
    converged = [*experiment.scenario.root.get("converged", {}), *experiment.fixed.get("converged", {})]
    keys = [key for key in [*experiment.fixed, *experiment.keys, *others] if key.startswith(CONVERGED)]
    return list(dict.fromkeys([*(CONVERGED + name for name in converged), *(re.sub(r"\.(from|to|seconds)$", "", key) for key in keys)]))


def _check_figures(experiment: Experiment, metrics: list[str]) -> None:
    """Checks that the metrics in `figures` and `labels` exist, and that no key or metric has the name of a convergence time."""
    numbers = [name for name, kind in tables.RUN_COLUMNS + tables.RUN_TIMES if not pa.types.is_string(kind)]
    converged = convergence_times(experiment)
    for name in metrics:
        if name in converged:
            raise ExperimentError(f"the metric '{name}' has the name of a column for the convergence time of another metric: rename one of them")
    for key in experiment.keys:
        if key in converged:
            raise experiment.located.error(f"'{key}' is also the name of a column for the convergence time of a metric: rename the metric",
                                           "vary" if key in dict(experiment.product) else "zip", key)
    at_end = [*metrics, *converged]
    for options in experiment.figures:
        check_metrics(options, at_end + numbers, metrics)
    check_labels(experiment, at_end + numbers)


def _place(experiment: Experiment, worker: Worker, problem: str) -> tuple[str | int, ...]:
    """Returns the location in the experiment file of the first key whose value causes the problem."""
    given = [*(("set", key, value) for key, value in experiment.fixed.items()),
             *((part, key, values[0]) for part, varied in (("vary", experiment.product), ("zip", experiment.together)) for key, values in varied)]
    settings: dict[str, object] = {}
    for part, key, value in given:
        settings[key] = value
        if worker.check(settings)[0] == problem:
            return part, key, *(() if part == "set" else (0,))
    return ()


def _sample(values: list[Any]) -> list[tuple[int, Any]]:
    """Returns the values to check with their indices. A long list comes from a range, so its first 99 values and the last one are sufficient."""
    indexed = list(enumerate(values))
    return indexed if len(indexed) <= 100 else [*indexed[:99], indexed[-1]]


class Progress:
    """Shows the progress in one line of a terminal. Without a terminal, prints a line every ten seconds."""

    def __init__(self, total: int, done: int, jobs: int):
        self.done = done
        self._total, self._jobs = total, jobs
        self._before = done
        self._failed = 0
        self._began = time.monotonic()
        self._next = self._began + (0 if sys.stderr.isatty() else 10)

    def ended(self, outcome: Outcome) -> None:
        """Counts a run."""
        self.done += outcome.status == "complete"
        self._failed += outcome.status != "complete"
        self.show()

    def show(self, at_once: bool = False) -> None:
        """Updates the line at most five times a second, or immediately with `at_once`."""
        now = time.monotonic()
        if now < self._next and not at_once:
            return
        self._next = now + (0.2 if sys.stderr.isatty() else 10)
        ended = self.done + self._failed
        left = self._total - ended
        rate = (ended - self._before) / (now - self._began) if now > self._began else 0
        remaining = f", {duration(left / rate)} left" if rate and left else ""
        line = f"{ended}/{self._total} runs, {self._failed} failed, {min(self._jobs, left)} running{remaining}"
        print("\r" + line + "\033[K" if sys.stderr.isatty() else line, end="" if sys.stderr.isatty() else "\n", file=sys.stderr, flush=True)

    def print(self, line: str) -> None:
        """Prints a separate line."""
        print(("\r\033[K" if sys.stderr.isatty() else "") + line, file=sys.stderr, flush=True)

    def end(self) -> None:
        """Shows the last line."""
        self.show(at_once=True)
        if sys.stderr.isatty():
            print(file=sys.stderr)


def duration(seconds: float) -> str:
    """Formats a duration."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
