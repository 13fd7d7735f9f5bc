"""Fixtures with sweeps of a project that has its own schema, Kotlin, C# and scenario."""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

ROOT = Path(__file__).resolve().parents[2]
COLLEKTIVE = str(ROOT / "collektive")
PROJECT = ROOT / "scripts/tests/acceptance/foreign"
GRADIENTS = ROOT / "experiments/gradients"


class Project:
    """A copy of the project, and sweeps of the copy."""

    def __init__(self, folder: Path):
        self.folder = folder
        shutil.copytree(PROJECT, folder / "project")

    def experiment(self, **keys: Any) -> str:
        """Writes an experiment file and returns its path."""
        path = self.folder / "experiment.json"
        path.write_text(json.dumps({"version": 1, "scenario": "project/lamps.json", **keys}, indent=1))
        return str(path)

    def command(self, *words: str) -> list[str]:
        return [sys.executable, "-m", "collektive_experiments", *words]

    def start(self, *words: str, out: str = "out", **keys: Any) -> subprocess.Popen[str]:
        """Starts a sweep into a folder."""
        return subprocess.Popen(self.command("sweep", self.experiment(**keys), "--out", str(self.folder / out), "--jobs", "2", *words), text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=os.environ, start_new_session=True)

    def sweep(self, *words: str, out: str = "out", **keys: Any) -> subprocess.CompletedProcess[str]:
        """Runs a sweep into a folder, for at most two minutes."""
        process = self.start(*words, out=out, **keys)
        try:
            output, errors = process.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        return subprocess.CompletedProcess(process.args, process.returncode, output, errors)

    def table(self, out: str = "out", name: str = "runs") -> pd.DataFrame:
        return pd.read_parquet(self.folder / out / f"{name}.parquet")

    def run(self, values: str, out: str = "out") -> Path:
        """Returns the folder of the run with the given values."""
        (found,) = (self.folder / out / "runs").glob(f"{values}-*")
        return found

    def digests(self, out: str = "out") -> dict[str, str]:
        """Returns the digests of all runs, by the name of the run."""
        table = self.table(out)
        return dict(zip(table["run"], table["digest"]))


def processes(*words: str) -> list[int]:
    """Returns the ids of the processes whose command lines contain all words."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            line = Path(f"/proc/{pid}/cmdline").read_bytes()
        except OSError:
            continue
        if all(word.encode() in line for word in words):
            found.append(int(pid))
    return found


@pytest.fixture
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A new copy of the project. All copies are in the same folder: scripts that no test has changed are compiled only once."""
    folder = tmp_path_factory.getbasetemp() / "project"
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir()
    return Project(folder)


@pytest.fixture(scope="session")
def lamps(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A project with a sweep of eight runs in `out`. Tests must not change this sweep."""
    finished_sweep = Project(tmp_path_factory.mktemp("lamps"))
    result = finished_sweep.sweep("--csv", **EIGHT)
    assert result.returncode == 0, result.stderr
    return finished_sweep


EIGHT: dict[str, Any] = {"vary": {"fields.lamps": [5, 10], "network.loss": [0, 0.3], "seed": "1-2"},
                         "set": {"outputs.nodes": {"fields": ["brightest", "position"], "interval": 0.5}, "converged.agreeing": {"from": 5, "seconds": 0.2}},
                         "measure": {"agreeing": "lamps"}}
