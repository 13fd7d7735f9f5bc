"""Tests the local pool with fake workers."""
import queue
import threading
from collections.abc import Iterator
from typing import Any, cast

import pytest

from collektive_experiments import sweep
from collektive_experiments.experiment import Experiment, Run
from collektive_experiments.positions import ExperimentError
from collektive_experiments.store import Store
from collektive_experiments.sweep import Ended, LocalPool
from collektive_experiments.worker import Outcome, Worker


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
    def __init__(self, name: str = "") -> None:
        self.name = name
        self.process = ""
        self.settings: dict[str, Any] = {}


class FakeStore:
    bundle = runs = ""

    def __init__(self, folder: str):
        self.logs = self.folder = folder

    def open(self, *_: Any) -> None:
        pass

    def write_settings(self) -> None:
        pass

    def is_complete(self, run: Run) -> bool:
        return False

    def record(self, run: Run) -> dict[str, Any] | None:
        return {"status": "differs"} if run.name == "0" else None

    def begin(self, run: Run) -> str:
        return ""

    def finish(self, *_: Any) -> None:
        pass


class FakeExperiment:
    count = 10
    scenario, runtimes = "", ()

    def runs(self) -> Iterator[Run]:
        return (cast(Run, FakeRun(str(index))) for index in range(self.count))


class FailingPool:
    """A pool whose runs all fail in the same way."""

    def start(self, tasks: list[sweep.Task], ended: "Events") -> None:
        for run, _ in tasks:
            ended.put((run, Outcome("failed", "no luck")))

    def stop(self) -> None:
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


class SlowWorker(FakeWorker):
    """A worker whose first run ends immediately."""

    def run(self, *_: Any) -> Outcome:
        return super().run() if self.began.is_set() else self.began.set() or Outcome("complete")


def test_an_error_while_results_are_written_is_reported_during_the_next_run(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    worker = SlowWorker()
    monkeypatch.setattr(sweep, "Worker", lambda *_: worker)

    def fail(*_: Any) -> None:
        raise OSError("No space left on device")

    monkeypatch.setattr(FakeStore, "finish", fail)
    pool = LocalPool(cast(Store, FakeStore(str(tmp_path))), 1, 60, False)
    ended: Events = queue.SimpleQueue()
    pool.start([(cast(Run, FakeRun()), False)] * 2, ended)
    try:
        assert str(ended.get(timeout=5)) == "No space left on device"
    finally:
        pool.stop()


def test_runs_that_gave_different_results_are_repeated_again(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sweep, "prepare", lambda *_: None)
    monkeypatch.setattr(sweep, "check_keys", lambda *_: None)
    todo = sweep.begin(cast(Experiment, FakeExperiment()), cast(Store, FakeStore(str(tmp_path))), True, False)
    assert [run.name for run, is_repeated in todo if is_repeated] == ["0", "2", "5", "9"]


def test_a_resumed_sweep_stops_after_equal_failures_and_writes_its_tables(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    written = []
    monkeypatch.setattr(sweep.tables, "write", lambda *_: written.append(True))
    experiment = FakeExperiment()
    todo: list[sweep.Task] = [(run, False) for run in experiment.runs()][3:]
    with pytest.raises(ExperimentError, match="its first 5 runs all failed in the same way"):
        sweep.sweep(cast(Experiment, experiment), cast(Store, FakeStore(str(tmp_path))), todo, FailingPool(), 1, False)
    assert written


def test_two_percent_of_many_runs_are_repeated() -> None:
    assert [len(list(sweep._spread(count))) for count in (1, 3, 150, 151, 1000)] == [1, 3, 3, 4, 20]


@pytest.mark.parametrize("missing", [0, 1])
def test_a_sweep_whose_tables_lack_a_run_is_an_error(missing: int, tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sweep.tables, "write", lambda *_: FakeExperiment.count - missing)

    def finish() -> int:
        return sweep.sweep(cast(Experiment, FakeExperiment()), cast(Store, FakeStore(str(tmp_path))), [], FailingPool(), 1, False)

    if missing:
        with pytest.raises(ExperimentError, match="the tables have 9 of 10 runs"):
            finish()
    else:
        assert finish() == 0


class IdleProcess:
    """A process that would execute a run unless it is killed first."""

    settings = ""
    is_killed = False

    def kill(self) -> None:
        self.is_killed = True

    def keeps_state(self) -> Outcome:
        return Outcome("crashed" if self.is_killed else "complete")

    def end(self) -> None:
        pass


def test_a_reused_process_does_not_run_after_kill(tmp_path: Any) -> None:
    worker = Worker(str(tmp_path), "")
    worker._idle = cast(Any, IdleProcess())
    worker.kill()
    assert worker.run({}, "", "", 60, False).status == "crashed"
