"""Tests the local pool with fake workers."""
import queue
import threading
from typing import Any, cast

import pytest

from collektive_experiments import sweep
from collektive_experiments.experiment import Run
from collektive_experiments.store import Store
from collektive_experiments.sweep import Ended, LocalPool
from collektive_experiments.worker import Outcome


class FakeWorker:
    """A worker whose run ends when the test requests it, or when the worker is killed."""

    def __init__(self, *_: Any):
        self.began = threading.Event()
        self.may_end = threading.Event()
        self.kills = 0
        self.stops = 0

    def run(self, *_: Any) -> Outcome:
        self.began.set()
        assert self.may_end.wait(60)
        return Outcome("crashed" if self.kills else "complete")

    def kill(self) -> None:
        self.kills += 1
        self.may_end.set()

    def stop(self) -> None:
        self.stops += 1


class FakeRun:
    def __init__(self) -> None:
        self.process = ""
        self.settings: dict[str, Any] = {}


class FakeStore:
    bundle = ""

    def __init__(self, folder: str):
        self.logs = folder

    def begin(self, run: Run) -> str:
        return ""

    def finish(self, *_: Any) -> None:
        pass


Events = queue.SimpleQueue[Ended | BaseException]


@pytest.fixture
def started(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> tuple[LocalPool, FakeWorker, Events]:
    """Returns a pool whose only worker has begun the only run."""
    worker = FakeWorker()
    monkeypatch.setattr(sweep, "Worker", lambda *_: worker)
    pool = LocalPool(cast(Store, FakeStore(str(tmp_path))), 1, 60, False)
    ended: Events = queue.SimpleQueue()
    pool.start([(cast(Run, FakeRun()), False)], ended)
    return pool, worker, ended


def test_a_worker_without_a_run_is_not_killed(started: tuple[LocalPool, FakeWorker, Events]) -> None:
    pool, worker, ended = started
    worker.may_end.set()
    event = ended.get(timeout=60)
    assert not isinstance(event, BaseException) and event[1].status == "complete"
    pool.stop()
    assert (worker.kills, worker.stops) == (0, 1)


def test_a_current_run_is_killed_and_discarded(started: tuple[LocalPool, FakeWorker, Events]) -> None:
    pool, worker, ended = started
    assert worker.began.wait(60)
    pool.stop()
    assert (worker.kills, worker.stops) == (1, 1)
    assert ended.empty()


def test_an_error_while_results_are_written_is_reported(started: tuple[LocalPool, FakeWorker, Events], monkeypatch: pytest.MonkeyPatch) -> None:
    pool, worker, ended = started

    def fail(*_: Any) -> None:
        raise OSError("No space left on device")

    monkeypatch.setattr(FakeStore, "finish", fail)
    worker.may_end.set()
    assert str(ended.get(timeout=60)) == "No space left on device"
    pool.stop()
    assert worker.stops == 1
