"""Reads and writes the folder of a sweep, which contains its settings, finished runs and tables."""
import fcntl
import hashlib
import json
import os
import sys
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO

from . import files
from .bundle import fingerprint
from .experiment import FIXED, Experiment, Run
from .files import MARKER, PART
from .positions import ExperimentError
from .worker import Outcome

VERSION = 3
RESULTS = ("manifest.json", "metrics.csv")
"""The files that each complete run has."""


class Store:
    """The folder of a sweep. When a run has ended, its folder is renamed to the final name."""

    def __init__(self, folder: str):
        self.folder = folder
        self.runs = os.path.join(folder, "runs")
        self.bundle = os.path.join(folder, "bundle")
        self.logs = os.path.join(folder, "logs")
        self._lock: BinaryIO | None = None
        self._settings: dict[str, Any] = {}

    def __enter__(self) -> "Store":
        return self

    def __exit__(self, *_: object) -> None:
        """Releases the folder."""
        if self._lock is not None:
            self._lock.close()

    def lock(self, shared: bool = False) -> None:
        """Locks the folder. Tasks of one job can share the lock. Raises `ExperimentError` if another sweep has locked the folder."""
        self._lock = files.open_log(os.path.join(self.folder, MARKER))
        try:
            fcntl.flock(self._lock, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ExperimentError(f"another sweep writes to '{self.folder}': name another folder with --out") from error

    def open(self, experiment: Experiment, resume: bool) -> None:
        """Creates or reopens the folder. Raises `ExperimentError` if it belongs to another sweep, or if it is not the folder of a sweep."""
        folder = os.path.realpath(self.folder)
        if any(character > "\uffff" for character in folder):
            raise ExperimentError(f"'{folder}' contains an emoji or another character beyond U+FFFF, and the JVM cannot load classes from there: "
                                  "name another folder with --out")
        if place := files.deletable_above(folder):
            raise ExperimentError(f"'{place}' belongs to a sweep, which may delete it: name another folder with --out")
        root = experiment.scenario.root
        for key in FIXED:
            part = os.path.abspath(os.path.join(os.path.dirname(experiment.scenario.path), str(root.get(key, ""))))
            if key in root and Path(os.path.realpath(part)) in Path(folder).parents:
                raise ExperimentError(f"the results would be inside '{part}', the scenario's '{key}': name another folder with --out")
        if not os.path.islink(self.folder) and os.path.isdir(self.folder) and os.listdir(self.folder) and not files.is_marked(self.folder):
            raise ExperimentError(f"'{self.folder}' is not empty and was not created by a sweep: name another folder with --out")
        files.make(self.folder)
        # `./collektive run` locks the folder before it writes its first file.
        descriptor = os.open(self.folder, os.O_RDONLY)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
            self.lock()
        except BlockingIOError as error:
            raise ExperimentError(f"a run writes to '{self.folder}': name another folder with --out") from error
        finally:
            os.close(descriptor)
        for folder in (self.runs, self.logs):
            files.make(folder)
        for folder in (self.folder, self.runs):
            for name in os.listdir(folder):
                if name.endswith(PART) and files.is_marked(os.path.join(folder, name)):
                    files.remove(os.path.join(folder, name))
        settings = {"version": VERSION, "experiment": os.path.basename(experiment.path), "keys": experiment.keys, "set": experiment.fixed,
                    "zip": [key for key, _ in experiment.together],
                    "measure": experiment.measure, "figures": experiment.located.root.get("figures", []), "labels": experiment.labels}
        if not os.listdir(self.runs):
            # The folder has no results yet, so the bundle can be created again. An interrupted deletion must not leave an incomplete bundle.
            if files.is_marked(self.bundle):
                os.rename(self.bundle, self.bundle + PART)
                files.remove(self.bundle + PART)
            files.remove(self.bundle)
        elif not resume:
            raise ExperimentError(f"'{self.folder}' has results of a sweep: continue it with --resume, or name another folder with --out")
        elif not os.path.isdir(self.bundle):
            # A new bundle could contain other inputs than those of the earlier runs.
            raise ExperimentError(f"'{self.bundle}' with the inputs of the earlier runs is missing: restore it, or name another folder with --out")
        else:
            self._require_same(settings)
        self._settings = settings

    def write_settings(self) -> None:
        """Writes the settings of the sweep, which `open` has checked."""
        self.require_owned()
        files.write(os.path.join(self.folder, "sweep.json"), json.dumps(self._settings, indent=2) + "\n")

    def settings(self) -> dict[str, Any]:
        """Returns the settings of the sweep."""
        path = os.path.join(self.folder, "sweep.json")
        if not os.path.exists(path):
            raise ExperimentError(f"'{self.folder}' is not a sweep folder: it has no sweep.json")
        settings = _object(path)
        lists = () if settings is None else (settings.get("keys"), settings.get("zip", []))
        if settings is None or settings.get("version") != VERSION or not all(map(_is_list_of_texts, lists)) or not all(
                isinstance(texts, dict) and _is_list_of_texts([*texts.values()]) for texts in (settings.get("measure"), settings.get("labels", {}))):
            raise ExperimentError(f"'{path}' is damaged or of another version: repair it with ./collektive sweep EXPERIMENT.json --out {self.folder} --resume")
        return settings

    @cached_property
    def inputs(self) -> str | None:
        """
        The fingerprint of the sweep's inputs, or None if only its results were copied.

        A run that was copied from a sweep with other inputs has another one in its run.json.
        """
        folder = os.path.join(self.bundle, "inputs")
        return fingerprint(folder) if os.path.isdir(folder) else None

    def is_complete(self, run: Run) -> bool:
        """Returns whether the run is complete. If its files are damaged or have other inputs, prints a message and deletes them."""
        folder = os.path.join(self.runs, run.name)
        if not os.path.lexists(folder):
            return False
        record = self.record(run)
        damaged = [files.RECORD] if record is None else self.changed_files(run, record)
        if record is None or damaged:
            path = os.path.join(folder, damaged[0])
            has_other_inputs = record is None and self._has_other_inputs(_object(path) or {})
            print(f"collektive: '{folder}' was copied from a sweep with other inputs; repeating the run" if has_other_inputs
                  else f"collektive: '{path}' is damaged; repeating the run", file=sys.stderr)
            files.remove(folder)
            return False
        return bool(record["status"] == "complete")

    def is_intact(self, run: Run) -> bool:
        """Returns whether the run is finished, and its files are undamaged."""
        record = self.record(run)
        return record is not None and not self.changed_files(run, record)

    def record(self, run: Run) -> dict[str, Any] | None:
        """Returns the content of run.json, or None if the run is not finished or has other inputs."""
        record = _object(os.path.join(self.runs, run.name, files.RECORD))
        if record is None or record.get("name") != run.name or self._has_other_inputs(record):
            return None
        if not _is_list_of_texts([record.get("status"), record.get("message")]):
            return None
        if not isinstance(record.get("files"), dict) or (record["status"] == "complete" and not set(RESULTS) <= record["files"].keys()):
            return None
        return record

    def _has_other_inputs(self, record: dict[str, Any]) -> bool:
        """Returns whether the run belongs to a sweep with other inputs. Sweeps of earlier versions did not write the inputs."""
        return "inputs" in record and self.inputs not in (None, record["inputs"])

    def count_complete_except(self, names: set[str]) -> int:
        """Returns the number of complete runs whose names are not in a set."""
        found = os.listdir(self.runs) if os.path.isdir(self.runs) else []
        return sum((self.record(Run(name, {}, {})) or {}).get("status") == "complete" for name in found if name not in names)

    def changed_files(self, run: Run, record: dict[str, Any]) -> list[str]:
        """Returns the names of the files that differ from their hashes in run.json."""
        return [name for name, digest in record["files"].items() if _hash(os.path.join(self.runs, run.name, name)) != digest]

    def require_owned(self) -> None:
        """Raises `ExperimentError` if the path no longer leads to the locked folder. Another sweep may use a new folder there."""
        if self._lock is None:
            return
        marker = os.path.join(self.folder, MARKER)
        if not os.path.exists(marker) or not os.path.samestat(os.stat(marker), os.fstat(self._lock.fileno())):
            raise ExperimentError(f"the sweep stopped: its folder '{self.folder}' was moved or deleted during the sweep")

    def begin(self, run: Run) -> str:
        """Creates an empty folder for a run, and returns its path."""
        self.require_owned()
        part = os.path.join(self.runs, run.name + PART)
        files.make_marked(part)
        return part

    def finish(self, run: Run, outcome: Outcome, seconds: float) -> None:
        """Writes run.json of a finished run, and renames the run's folder to its final name."""
        self.require_owned()
        folder = os.path.join(self.runs, run.name)
        part = folder + PART
        names = [entry.name for entry in os.scandir(part) if entry.is_file(follow_symlinks=False) and entry.name != MARKER]
        results = {name: _hash(os.path.join(part, name)) for name in sorted(names)}
        if outcome.status == "complete" and not set(RESULTS) <= results.keys():
            outcome = Outcome("failed", f"the run did not write {' and '.join(name for name in RESULTS if name not in results)}")
        record = {"name": run.name, "inputs": self.inputs, "values": run.values, "status": outcome.status, "message": outcome.message,
                  "seconds": round(seconds, 3), "files": results}
        files.write_part(os.path.join(part, files.RECORD), json.dumps(record, indent=2) + "\n")
        files.remove(folder)
        files.publish(folder)

    def _require_same(self, settings: dict[str, Any]) -> None:
        former = _object(os.path.join(self.folder, "sweep.json"))
        if former is None:
            print(f"collektive: '{os.path.join(self.folder, 'sweep.json')}' is damaged; writing it again from the experiment file", file=sys.stderr)
            return
        for key in ("version", "keys", "set"):
            if former.get(key) != settings[key]:
                raise ExperimentError(f"'{self.folder}' belongs to a sweep whose '{key}' is {json.dumps(former.get(key))}, not {json.dumps(settings[key])}: "
                                      "name another folder with --out")


def _object(path: str) -> dict[str, Any] | None:
    """Returns the JSON object in a file, or None if the file is absent or damaged."""
    # Opening a pipe would wait for its writer.
    if not files.is_file(path):
        return None
    try:
        with open(path, "rb") as file:
            value = json.loads(file.read())
    except (ValueError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def _is_list_of_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(item, str) for item in value)


def _hash(path: str) -> str:
    if not files.is_file(path):
        return ""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
