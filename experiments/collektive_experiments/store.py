"""The folder of a sweep: what was asked, the runs that are done, and the tables."""
import fcntl
import json
import os
import shutil
from collections.abc import Iterator
from typing import Any, TextIO

from .experiment import Experiment, Run
from .positions import ExperimentError
from .worker import Outcome

VERSION = 1
PART = ".part"
"""End of the name of a run's folder until the run has ended."""


class Store:
    """The folder of a sweep. A run's folder has its final name once the run has ended, so what is there is whole."""

    def __init__(self, folder: str):
        self.folder = folder
        self.runs = os.path.join(folder, "runs")
        self.bundle = os.path.join(folder, "bundle")
        self._lock: TextIO | None = None

    def open(self, experiment: Experiment, resume: bool) -> None:
        """Makes the folder, or takes up what is in it. Raises `ExperimentError` when it is another sweep's, or in use."""
        path = os.path.join(self.folder, "sweep.json")
        asked = {"version": VERSION, "experiment": os.path.basename(experiment.path), "keys": experiment.keys, "set": experiment.fixed,
                 "measure": experiment.measure}
        os.makedirs(self.runs, exist_ok=True)
        self._lock = open(os.path.join(self.folder, ".lock"), "w")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ExperimentError(f"another sweep writes to '{self.folder}': name another folder with --out") from error
        for name in os.listdir(self.runs):
            if name.endswith(PART):
                shutil.rmtree(os.path.join(self.runs, name))
        if not os.listdir(self.runs):
            # Nothing is lost of a sweep that did not come to its first result.
            shutil.rmtree(self.bundle, ignore_errors=True)
        elif os.path.exists(path):
            if not resume:
                raise ExperimentError(f"'{self.folder}' has results of a sweep: go on with --resume, or name another folder with --out")
            former = self.asked()
            for key in ("keys", "set"):
                if former[key] != asked[key]:
                    raise ExperimentError(f"'{self.folder}' is of a sweep with {json.dumps(former[key])} as its {key}, not {json.dumps(asked[key])}: "
                                          "name another folder with --out")
        write(path, json.dumps(asked, indent=2) + "\n")

    def asked(self) -> dict[str, Any]:
        """What the sweep was asked."""
        try:
            with open(os.path.join(self.folder, "sweep.json")) as file:
                asked: dict[str, Any] = json.load(file)
        except FileNotFoundError as error:
            raise ExperimentError(f"'{self.folder}' is no folder of a sweep: it has no sweep.json") from error
        return asked

    def is_complete(self, run: Run) -> bool:
        """Whether the run is done and need not be done again."""
        record = self.record(run.name)
        return record is not None and record["status"] == "complete"

    def record(self, name: str) -> dict[str, Any] | None:
        """run.json of a run that has ended, or None."""
        try:
            with open(os.path.join(self.runs, name, "run.json")) as file:
                record: dict[str, Any] = json.load(file)
        except FileNotFoundError:
            return None
        return record

    def place(self, run: Run) -> str:
        """An empty folder for a run that begins."""
        part = os.path.join(self.runs, run.name + PART)
        shutil.rmtree(part, ignore_errors=True)
        os.mkdir(part)
        return part

    def finish(self, run: Run, number: int, outcome: Outcome, seconds: float) -> None:
        """Gives a run that has ended its name, and its place among the runs."""
        part, folder = os.path.join(self.runs, run.name + PART), os.path.join(self.runs, run.name)
        record = {"name": run.name, "number": number, "values": run.values, "status": outcome.status, "message": outcome.message, "seconds": round(seconds, 3)}
        write(os.path.join(part, "run.json"), json.dumps(record, indent=2) + "\n")
        if os.path.isdir(folder):
            shutil.rmtree(folder)
        os.rename(part, folder)

    def records(self) -> Iterator[dict[str, Any]]:
        """run.json of all runs that have ended, in the experiment's order."""
        numbered = []
        for name in os.listdir(self.runs):
            record = None if name.endswith(PART) else self.record(name)
            if record:
                numbered.append((record["number"], name))
        for _, name in sorted(numbered):
            record = self.record(name)
            assert record
            yield record


def write(path: str, text: str) -> None:
    """Writes a file that is whole or not there."""
    part = path + PART
    with open(part, "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(part, path)
