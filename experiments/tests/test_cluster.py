"""Tests sweeps on a Ray cluster that loses nodes or workers."""
import os
import queue
import signal
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import Mock

import pytest
import ray
from conftest import Project
from ray.cluster_utils import Cluster
from test_sweep import await_runs

from collektive_experiments import cluster as clusters
from collektive_experiments.cluster import RayPool
from collektive_experiments.experiment import Run
from collektive_experiments.positions import ExperimentError

KEYS = {"vary": {"seed": "1-16", "network.loss": [0.3]}, "set": {"seconds": 10}}


@pytest.fixture
def cluster(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Cluster]:
    """A cluster of two nodes, whose processes communicate over the loopback interface. Its workers have their files in `tmp_path`."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    # Ray's own files include sockets, whose paths must be short.
    monkeypatch.setenv("RAY_TMPDIR", "/tmp")
    # With these settings, Ray detects a lost node within two seconds instead of twenty.
    checks = {"health_check_initial_delay_ms": 0, "health_check_period_ms": 500, "health_check_failure_threshold": 3}
    two_nodes = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False, "_system_config": checks})
    two_nodes.add_node(num_cpus=1)
    two_nodes.wait_for_nodes()
    yield two_nodes
    two_nodes.shutdown()


def test_a_lost_cluster_node_causes_no_lost_or_duplicate_runs(project: Project, cluster: Cluster) -> None:
    other = next(iter(cluster.worker_nodes))
    driver = project.start("--ray", cluster.address, **KEYS)
    await_runs(project, 4)
    cluster.remove_node(other, allow_graceful=False)
    _, errors = driver.communicate(timeout=120)
    assert driver.returncode == 0, errors
    local = project.sweep(out="local", **KEYS)
    assert local.returncode == 0, local.stderr
    assert project.digests() == project.digests("local")
    assert list(project.table()["run"]) == list(project.table("local")["run"])


def test_ignored_files_of_the_data_folder_are_copied_to_the_nodes(project: Project, cluster: Cluster) -> None:
    scenario = project.folder / "project/lamps.json"
    scenario.write_text(scenario.read_text().replace("{", '{"data": "data",', 1))
    for name in (".gitignore", ".rayignore", "venv/table"):
        file = project.folder / "project/data" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("*")
    result = project.sweep("--ray", cluster.address, vary={"seed": [1, 2]})
    # Workers compare the fingerprint of their copy.
    assert result.returncode == 0, result.stderr


def test_workers_delete_their_files_after_a_sweep_or_ctrl_c(project: Project, cluster: Cluster, tmp_path: Path) -> None:
    driver = project.start("--ray", cluster.address, **KEYS)
    await_runs(project, 2)
    os.kill(driver.pid, signal.SIGINT)
    _, errors = driver.communicate(timeout=60)
    assert driver.returncode == 130, errors
    assert not list(tmp_path.glob("collektive-*"))
    resumed = project.sweep("--ray", cluster.address, "--resume", **KEYS)
    assert resumed.returncode == 0, resumed.stderr
    assert len(project.digests()) == 16
    assert not list(tmp_path.glob("collektive-*"))


@pytest.mark.parametrize("error", [ValueError("invalid"), ray.exceptions.RuntimeEnvSetupError("too large")])
def test_an_invalid_address_or_bundle_is_reported(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, error: Exception) -> None:
    monkeypatch.setattr(ray, "init", Mock(side_effect=error))
    with pytest.raises(ExperimentError, match="cannot use the Ray cluster at 'address'"):
        clusters.connect("address", str(tmp_path))


def test_a_run_whose_workers_are_killed_for_memory_crashes_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clusters, "connect", Mock())
    monkeypatch.setattr(ray, "get", Mock(side_effect=ray.exceptions.OutOfMemoryError("the memory is full\nusage: 99 %")))
    store = Mock(bundle="")
    pool = RayPool(store, "auto", 1, False)
    pool._ended = queue.SimpleQueue()
    task = Run("run", {}, {}), False
    assert [pool._take(None, task) for _ in range(3)] == [False] * 3
    assert list(pool._tasks) == [task] * 2, "the run must be repeated twice"
    outcome = store.finish.call_args.args[1]
    assert (outcome.status, outcome.message) == ("crashed", "3 workers were lost during the run (OutOfMemoryError)")
