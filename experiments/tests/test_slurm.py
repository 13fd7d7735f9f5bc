"""Tests the tasks of Slurm jobs without a cluster."""
import fcntl
import os
import subprocess
from pathlib import Path

import pytest

from collektive_experiments import __main__ as command
from collektive_experiments.experiment import Run
from collektive_experiments.positions import ExperimentError
from collektive_experiments.slurm import write_job
from collektive_experiments.store import Store
from collektive_experiments.worker import WorkerError


def test_a_shared_lock_is_readable_for_nfs(tmp_path: Path) -> None:
    with Store(str(tmp_path)) as store:
        store.lock(shared=True)
        assert store._lock is not None
        assert fcntl.fcntl(store._lock, fcntl.F_GETFL) & os.O_ACCMODE == os.O_RDWR


def test_a_task_does_not_import_modules_from_the_current_folder(tmp_path: Path) -> None:
    store = Store(str(tmp_path / "out"))
    os.makedirs(store.logs)
    script = write_job(store, [(Run("run", {}, {}), False)], 1, 60, False)
    (tmp_path / "queue.py").write_text("raise ImportError('of the user')")
    result = subprocess.run([script], cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "SLURM_ARRAY_TASK_ID": "1"})
    assert "the job has no task 1" in result.stderr


def test_a_node_without_a_jdk_is_reported_in_one_line(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def run_task(*_: object) -> int:
        raise WorkerError("no JDK 17 or newer found")

    monkeypatch.setattr(command, "run_task", run_task)
    assert command.main(["task", "out", "0"]) == 1
    assert capsys.readouterr().err == "collektive: no JDK 17 or newer found\n"


def test_a_script_contains_the_folder_only_in_quotes(tmp_path: Path) -> None:
    store = Store(str(tmp_path / "50 %j; $(touch x)"))
    os.makedirs(store.logs)
    script = Path(write_job(store, [(Run("run", {}, {}), False)], 1, 60, False)).read_text()
    assert f"#SBATCH --output='{tmp_path}/50 %%j; $(touch x)/logs'/slurm-%a.txt" in script
    for name in ("a\ntouch x", "a\\b"):
        with pytest.raises(ExperimentError, match="contains a line break or backslash"):
            write_job(Store(str(tmp_path / name)), [], 1, 60, False)
