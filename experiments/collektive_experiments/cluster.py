"""Runs a sweep on a Ray cluster. Each worker is an actor, and Ray copies the bundle and this package to all nodes."""
import io
import logging
import os
import queue
import shutil
import tarfile
import tempfile
import threading
import time
from collections import deque
from typing import Any

import ray

from .bundle import is_unchanged
from .experiment import Run
from .positions import ExperimentError
from .store import Store
from .sweep import Ended, Task
from .worker import Outcome, Worker, WorkerError

MAX_LOSSES = 3
"""The number of lost workers after which a run counts as crashed."""
WAIT_SECONDS = 0.5
CLOSE_SECONDS = 5.0
"""The time limit in seconds until workers have deleted their files."""


def connect(address: str, bundle: str) -> None:
    """Joins a cluster. The address `auto` joins the local cluster, or starts one for the sweep if none is running."""
    with tempfile.TemporaryDirectory(prefix="collektive-") as folder:
        # Ray would omit files of a folder that .gitignore, .rayignore or its own list name.
        archive = os.path.join(folder, "bundle.tar.gz")
        with tarfile.open(archive, "w:gz", compresslevel=1, dereference=True) as tar:
            tar.add(bundle, ".")
        _connect(address, {"working_dir": archive, "py_modules": [os.path.dirname(os.path.abspath(__file__))]})


def _connect(address: str, environment: dict[str, Any]) -> None:
    try:
        ray.init(address=address, runtime_env=environment, log_to_driver=False, logging_level=logging.ERROR)
    except RuntimeError as error:
        if "Version mismatch" not in str(error):
            raise
        raise ExperimentError(f"{' '.join(str(error).split())} Install the same versions of Ray and Python on all nodes.") from error
    except ConnectionError as error:
        if address != "auto":
            raise ExperimentError(f"cannot connect to the Ray cluster at {address}: {error}") from error
        ray.init(runtime_env=environment, include_dashboard=False, log_to_driver=False, logging_level=logging.ERROR)
    # For example, the address is invalid, or the bundle is too large.
    except (ValueError, ray.exceptions.RayError) as error:
        raise ExperimentError(f"cannot use the Ray cluster at '{address}': {error}") from error


# A worker can be closed during a run.
@ray.remote(num_cpus=1, max_restarts=0, max_concurrency=2)
class _RemoteWorker:
    """A worker on a node of the cluster. Its working directory is the bundle."""

    def __init__(self, trust: bool):
        self._folder = tempfile.TemporaryDirectory(prefix="collektive-")
        self._worker = Worker(os.getcwd(), os.path.join(self._folder.name, "worker.txt"), trust)
        self._lock = threading.Lock()
        self._count = 0
        self._is_copied = is_unchanged(os.getcwd())

    def close(self) -> None:
        """Cancels the current run, and deletes all files."""
        self._worker.kill()
        with self._lock:
            self._worker.stop()
            self._folder.cleanup()

    def run(self, settings: dict[str, Any], process: str, limit: float, is_repeated: bool) -> tuple[Outcome, float, bytes]:
        """Executes a run. Returns its outcome, its duration in seconds, and its folder as a tar file."""
        if not self._is_copied:
            raise WorkerError("the copy of the bundle on a node of the cluster differs from the bundle")
        with self._lock:
            self._count += 1
            out = os.path.join(self._folder.name, str(self._count))
            os.mkdir(out)
            began = time.monotonic()
            outcome = self._worker.run(settings, process, out, limit, is_repeated)
            seconds = time.monotonic() - began
            packed = io.BytesIO()
            with tarfile.open(fileobj=packed, mode="w:gz") as tar:
                tar.add(out, ".")
            shutil.rmtree(out)
            return outcome, seconds, packed.getvalue()


# Type checkers cannot infer the class that Ray's decorator returns.
RemoteWorker: Any = _RemoteWorker


def _close(workers: list[Any]) -> None:
    """Ends workers after they have deleted their files."""
    if workers:
        ray.wait([worker.close.remote() for worker in workers], num_returns=len(workers), timeout=CLOSE_SECONDS)
    while workers:
        ray.kill(workers.pop())


class RayPool:
    """A pool with a worker on each processor of a cluster. If a worker is lost, another one repeats its run."""

    def __init__(self, store: Store, address: str, limit: float, trust: bool):
        connect(address, os.path.abspath(store.bundle))
        self._store, self._limit, self._trust = store, limit, trust
        self._thread = threading.Thread(target=self._work)
        self._stopped = False
        self._tasks: deque[Task] = deque()
        self._losses: dict[str, int] = {}

    def start(self, tasks: list[Task], ended: "queue.SimpleQueue[Ended | BaseException]") -> None:
        """Starts the runs, grouped by JVM settings."""
        self._ended = ended
        self._tasks.extend(sorted(tasks, key=lambda task: task[0].process))
        self._thread.start()

    def stop(self) -> None:
        """Cancels the current runs and leaves the cluster."""
        self._stopped = True
        if self._thread.is_alive():
            self._thread.join()
        ray.shutdown()

    def _work(self) -> None:
        try:
            idle: list[Any] = []
            running: dict[Any, tuple[Any, Task]] = {}
            while (self._tasks or running) and not self._stopped:
                # The number of processors can change, because nodes may join and leave.
                processors = int(ray.cluster_resources().get("CPU", 1))  # type: ignore[no-untyped-call]
                needed = min(processors, len(self._tasks) + len(running))
                while len(running) + len(idle) < needed:
                    idle.append(RemoteWorker.remote(self._trust))
                while idle and self._tasks:
                    worker, task = idle.pop(), self._tasks.popleft()
                    run, is_repeated = task
                    running[worker.run.remote(run.settings, run.process, self._limit, is_repeated)] = worker, task
                # Idle workers must release their processors. After the loss of a node, a requested worker may be waiting for one of them.
                _close(idle)
                done, _ = ray.wait(list(running), timeout=WAIT_SECONDS)
                for reference in done:
                    worker, task = running.pop(reference)
                    if self._take(reference, task):
                        idle.append(worker)
            _close([*idle, *(worker for worker, _ in running.values())])
        except BaseException as error:
            self._ended.put(error)

    def _take(self, reference: Any, task: Task) -> bool:
        """Stores the result of a run. Returns whether its worker is still running."""
        name = task[0].name
        try:
            outcome, seconds, packed = ray.get(reference)
        except ray.exceptions.RayTaskError as error:
            raise WorkerError(str(error.cause)) from error
        except ray.exceptions.RayError as error:
            # For example, the node was lost, or Ray killed the worker because the node's memory was full.
            self._losses[name] = self._losses.get(name, 0) + 1
            if self._losses[name] < MAX_LOSSES:
                self._tasks.appendleft(task)
                return False
            outcome, seconds, packed = Outcome("crashed", f"{MAX_LOSSES} workers were lost during the run ({type(error).__name__})"), 0.0, b""
            self._finish(task[0], outcome, seconds, packed)
            return False
        self._finish(task[0], outcome, seconds, packed)
        return True

    def _finish(self, run: Run, outcome: Outcome, seconds: float, packed: bytes) -> None:
        place = self._store.begin(run)
        if packed:
            with tarfile.open(fileobj=io.BytesIO(packed)) as tar:
                tar.extractall(place, filter="data")
        self._store.finish(run, outcome, seconds)
        self._ended.put((run, outcome))
