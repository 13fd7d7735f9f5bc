"""Tests whole sweeps, including crashes, full disks and invalid input."""
import fcntl
import hashlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from conftest import COLLEKTIVE, EIGHT, GRADIENTS, ROOT, Project, processes

from collektive_experiments import ExperimentError, compare, files, load, read, sweep, tables
from collektive_experiments.__main__ import main
from collektive_experiments.experiment import Run
from collektive_experiments.store import Store
from collektive_experiments.worker import TIMES, Outcome

MANY = {"vary": {"seed": "1-16"}, "set": {"seconds": 20}}
"""Keys of a sweep whose runs last long enough for tests to disturb them."""


def await_runs(project: Project, count: int, out: str = "out") -> None:
    """Waits until the given number of runs have ended."""
    end = time.monotonic() + 60
    runs = project.folder / out / "runs"
    while not runs.is_dir() or sum(not name.endswith(".part") for name in os.listdir(runs)) < count:
        assert time.monotonic() < end, "the runs must end within the time limit"
        time.sleep(0.02)


def workers(project: Project) -> list[int]:
    """Returns the ids of processes that run scenarios of the project."""
    return processes("serve", str(project.folder))


def await_no_worker(project: Project) -> None:
    end = time.monotonic() + 20
    while workers(project):
        assert time.monotonic() < end, "no worker may be left"
        time.sleep(0.05)


def test_each_run_is_a_row_with_its_parameters_and_results(lamps: Project) -> None:
    runs = lamps.table()
    assert list(runs.columns[:8]) == ["run", "fields.lamps", "network.loss", "seed", "status", "message", "digest", "nodes"]
    assert len(runs) == 8
    assert set(runs["status"]) == {"complete"}
    assert list(runs["nodes"]) == list(runs["fields.lamps"])
    assert runs["seed"].dtype == "uint64", "if this depended on the values, pandas would round the seeds of combined tables"
    assert [name.rpartition("-")[0] for name in runs["run"][:2]] == ["fields.lamps=5,network.loss=0,seed=1", "fields.lamps=5,network.loss=0,seed=2"]
    assert list(runs.loc[runs["network.loss"] == 0, "agreeing"]) == [5, 5, 10, 10]
    assert "seen" not in runs.columns, "a metric that is not measured must not have a column"
    assert list(runs.loc[runs["network.loss"] == 0, "converged.agreeing"]) == [1.0] * 4 or runs["converged.agreeing"].isna().any()
    # The runs last 1 s, and a run converges only if it stays in the band for 0.2 s.
    assert set(runs.loc[runs["converged.agreeing"].isna(), "censored.agreeing"]) <= {0.8}
    assert (runs["converged.agreeing"].isna() != runs["censored.agreeing"].isna()).all()


def test_series_have_a_row_per_second_and_nodes_a_row_per_node(lamps: Project) -> None:
    series = lamps.table(name="series")
    assert list(series["second"]) == [0, 1] * 8
    assert list(series.columns[:6]) == ["run", "fields.lamps", "network.loss", "seed", "second", "agreeing"]
    nodes = lamps.table(name="nodes")
    assert len(nodes) == 3 * 4 * (5 + 10)
    last = nodes[(nodes["fields.lamps"] == 10) & (nodes["network.loss"] == 0) & (nodes["second"] == 1)]
    assert set(last["brightest"]) == {10.0}
    assert list(last["position.x"][:10]) == list(range(10))


def test_tables_are_read_above_a_symbolic_link(lamps: Project, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(lamps.folder / "out")
    assert len(load(str(tmp_path / "link/../out")).runs) == 8


def test_tables_are_also_written_as_csv(lamps: Project) -> None:
    for name in ("runs", "series"):
        table = pd.read_csv(lamps.folder / "out" / f"{name}.csv")
        assert list(table.columns) == pq.read_schema(lamps.folder / "out" / f"{name}.parquet").names
        assert len(table) == len(lamps.table(name=name))


def test_digests_do_not_depend_on_the_number_of_workers_or_processes(lamps: Project, tmp_path: Path) -> None:
    result = lamps.sweep("--jobs", "1", out="one", **EIGHT)
    assert result.returncode == 0, result.stderr
    assert lamps.digests("one") == lamps.digests()
    manifest = lamps.run("fields.lamps=10,network.loss=0.3,seed=2") / "manifest.json"
    repeated = subprocess.run([COLLEKTIVE, "repeat", str(manifest), "--out", str(tmp_path / "again")], capture_output=True, text=True)
    assert repeated.returncode == 0, repeated.stderr
    assert "repeated: 10 ticks" in repeated.stdout


def test_scripts_are_initialised_as_in_a_single_run(project: Project, tmp_path: Path) -> None:
    scene = project.folder / "project/scene/Lamps.cs"
    method = """[RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.BeforeSceneLoad)] private static void Initialise() => added++;
        private static int added;
        protected override void Build(SimulationManager manager)
        {
            lamps += added + (Application.isEditor ? 100 : 0);"""
    scene.write_text(scene.read_text().replace("protected override void Build(SimulationManager manager)\n        {", method))
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 0, result.stderr
    assert project.table()["nodes"].tolist() == [11]
    repeated = subprocess.run([COLLEKTIVE, "repeat", str(project.run("seed=1") / "manifest.json"), "--out", str(tmp_path / "again")],
                              capture_output=True, text=True)
    assert repeated.returncode == 0, repeated.stderr


def test_a_completed_sweep_repeats_no_runs_and_can_be_extended(lamps: Project) -> None:
    record = lamps.run("fields.lamps=5,network.loss=0,seed=1") / "run.json"
    before = record.stat().st_mtime_ns
    refused = lamps.sweep(**EIGHT)
    assert refused.returncode == 1
    assert "continue it with --resume" in refused.stderr
    resumed = lamps.sweep("--resume", "--csv", **EIGHT)
    assert resumed.returncode == 0, resumed.stderr
    assert "8 of 8 runs are already complete" in resumed.stderr
    assert record.stat().st_mtime_ns == before
    other = lamps.sweep("--resume", **{**EIGHT, "set": {"seconds": 3}})
    assert "name another folder with --out" in other.stderr


def test_runs_and_tables_of_a_sweep_with_other_inputs_are_not_used(project: Project) -> None:
    assert project.sweep(vary={"seed": [1, 2]}).returncode == 0
    before = project.digests()
    scenario = project.folder / "project/lamps.json"
    original = scenario.read_text()
    scenario.write_text(json.dumps({**json.loads(original), "seconds": 2}))
    assert project.sweep(out="other", vary={"seed": [1, 2]}).returncode == 0
    scenario.write_text(original)
    run = project.run("seed=1")
    shutil.rmtree(run)
    shutil.copytree(project.folder / "other/runs" / run.name, run)
    result = project.sweep("--resume", vary={"seed": [1, 2]})
    assert (result.returncode, result.stderr.count("was copied from a sweep with other inputs; repeating the run")) == (0, 1), result.stderr
    assert project.digests() == before
    load(str(project.folder / "out"))
    shutil.copy(project.folder / "other/series.parquet", project.folder / "out")
    with pytest.raises(ExperimentError, match="do not belong together"):
        load(str(project.folder / "out"))


@pytest.mark.parametrize("schedule", ["Lockstep", pytest.param("Asynchronous", marks=pytest.mark.slow)])
def test_keys_without_an_effect_are_reported(schedule: str, project: Project) -> None:
    result = project.sweep(vary={"timing.period": [0.1, 0.3], "threads": [1, 2], "seed": "1-2"}, set={"seconds": 1, "schedule": schedule, "network.loss": 0.3},
                           zip={"fields.lamps": [3, 3, 5], "outputs.interval": [0.5, 1, 1]})
    assert result.returncode == 0, result.stderr
    lines = [line for line in result.stderr.splitlines() if "equal results" in line]
    assert lines == (["collektive: runs that differ only in 'timing.period' have equal results"] if schedule == "Lockstep" else [])


@pytest.mark.slow
def test_csv_tables_do_not_become_outdated(project: Project) -> None:
    keys = {"set": {"outputs.nodes": {"fields": ["position"]}}}
    assert project.sweep("--csv", vary={"seed": [1]}, **keys).returncode == 0
    for name in ("runs", "series"):
        (project.folder / f"out/{name}.csv").unlink()
    assert project.sweep("--resume", vary={"seed": [1, 2]}, **keys).returncode == 0
    for name in ("runs", "series", "nodes"):
        assert list(pd.read_csv(project.folder / f"out/{name}.csv")["seed"].unique()) == [1, 2]


@pytest.mark.slow
def test_a_table_of_deleted_runs_does_not_remain(project: Project) -> None:
    assert project.sweep("--csv", vary={"seed": [1]}, set={"outputs.nodes": {"fields": ["position"]}}).returncode == 0
    shutil.rmtree(project.folder / "out/runs")
    result = project.sweep(vary={"seed": [1]})
    assert result.returncode == 0, result.stderr
    assert list((project.folder / "out").glob("nodes.*")) == []


def test_changed_scripts_are_not_mixed_with_earlier_runs(project: Project) -> None:
    keys = {"vary": {"seed": [1]}}
    assert project.sweep(vary={"sed": [1]}).returncode == 1
    # A sweep that fails before its first run does not keep the folder locked.
    assert project.sweep(**keys).returncode == 0
    scene = project.folder / "project/scene/Lamps.cs"
    scene.write_text(scene.read_text() + "\n// other\n")
    result = project.sweep("--resume", **keys)
    assert result.returncode == 1
    assert "differ from those of the runs in" in result.stderr


@pytest.mark.parametrize(("keys", "line", "message"), [
    ({"vary": {"fields.lampz": [1]}}, 6, "has no public field 'lampz'; it has: lamps, loop"),
    ({"vary": {"fields.lamps": [1, "many"]}}, 7, "'lamps' is \"many\"; it must be of type whole number"),
    ({"set": {"network.los": 1}}, 5, "unknown key 'network.los'"),
    ({"vary": {"seed": [1]}, "measure": ["glow"]}, 9, "the scene has no metric 'glow'; it has: agreeing, seen"),
    ({"set": {"converged.seen": {"from": 1}}, "figures": [{"metric": "converged.glow", "kind": "ecdf"}]}, 11,
     "'figures[0].metric' is 'converged.glow', which does not exist; existing metrics: agreeing, seen, converged.seen, nodes"),
    ({"vary": {"seed": [1]}, "labels": {"glow": "x"}}, 10, "'labels.glow' is unknown: it is not one of the varied keys (seed)"),
])
def test_an_unknown_scenario_key_is_reported_before_any_run(
        lamps: Project, keys: dict[str, object], line: int, message: str, tmp_path: Path) -> None:
    result = lamps.sweep("--csv", out=str(tmp_path / "out"), **keys)
    assert result.returncode == 1
    assert message in result.stderr
    assert f"experiment.json:{line}: " in result.stderr
    assert not os.listdir(tmp_path / "out/runs")


@pytest.mark.slow
def test_keys_are_checked_in_the_combinations_that_run(project: Project) -> None:
    # No run combines the longer tick with the shorter interval, or the metrics with the scenario's bands.
    result = project.sweep(vary={"seed": [1]}, zip={"deltaTime": [0.1, 0.5], "outputs.interval": [0.2, 0.5]},
                           set={"metrics": {"a": "count(*)"}, "converged": {"a": {"from": 1}}})
    assert result.returncode == 0, result.stderr
    result = project.sweep(out="other", zip={"deltaTime": [0.1, 0.5], "outputs.interval": [0.2, 0.3]})
    assert "experiment.json:7: " in result.stderr
    assert "'outputs.interval' is 0.3: it must be at least 'deltaTime', 0.5 s" in result.stderr


@pytest.mark.slow
def test_results_may_be_in_a_folder_with_colons(project: Project) -> None:
    result = project.sweep(out="a:b;c \u00fc", vary={"jvm.placement": ["InProcess", "OwnProcess"]})
    assert result.returncode == 0, result.stderr


@pytest.mark.slow
def test_a_field_with_the_name_of_a_column_has_its_own_column(project: Project) -> None:
    for name, before, after in [("light.fbs", "brightest:", "node:"), ("programs/Brightest.kt", "ActuatorData(brightest", "ActuatorData(node"),
                                ("scene/Lamps.cs", "data.Brightest", "data.Node"), ("scene/Lamps.cs", "answer.Brightest", "answer.Node")]:
        file = project.folder / "project" / name
        file.write_text(file.read_text().replace(before, after))
    result = project.sweep(vary={"seed": [1]}, set={"outputs.nodes.fields": ["node"]})
    assert result.returncode == 0, result.stderr
    [table] = (project.folder / "out/runs").glob("*/nodes.csv")
    assert table.read_text().startswith("second,node,field.node\n")
    last = project.table(name="nodes").tail(10)
    assert list(last["node"]) == list(range(10))
    assert set(last["field.node"]) == {10.0}


@pytest.mark.slow
def test_infinite_values_texts_and_large_whole_numbers_of_nodes_are_exact(project: Project) -> None:
    texts = ["", "\"\",\n\"", "a,b", "null"]
    answer = (f'ActuatorData(brightest = -1f / 0f, text = listOf({", ".join(map(json.dumps, texts))})[mine.toInt() % 4], '
              "large = 9007199254740993L - mine.toLong(), ticks = -1L,")
    for name, before, after in [("light.fbs", "seen:", "text: string; large: long; ticks: ulong; seen:"),
                                ("programs/Brightest.kt", "ActuatorData(brightest = best,", answer)]:
        file = project.folder / "project" / name
        file.write_text(file.read_text().replace(before, after))
    result = project.sweep("--csv", vary={"seed": [1]}, set={"outputs.nodes.fields": ["text", "brightest", "large", "ticks"]})
    assert result.returncode == 0, result.stderr
    nodes = pq.read_table(project.folder / "out/nodes.parquet")
    assert set(nodes["brightest"].to_pylist()) == {None, -math.inf}
    assert set(nodes["text"].to_pylist()) == {None, *texts}
    assert [str(nodes.schema.field(name).type) for name in ("large", "ticks")] == ["int64", "uint64"]
    assert 9007199254740993 - 3 in nodes["large"].to_pylist()
    assert nodes["ticks"].to_pylist()[-1] == 18446744073709551615
    assert ",9007199254740990,18446744073709551615" in (project.folder / "out/nodes.csv").read_text()


def test_no_table_is_replaced_if_the_disk_is_full_during_the_last_one(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    path = project.experiment(vary={"seed": [1]}, set={"outputs.nodes.fields": ["position"]})
    command = ["sweep", path, "--out", str(project.folder / "out"), "--jobs", "1"]
    assert main(command) == 0
    before = {name: list(project.table(name=name)["run"]) for name in ("runs", "series", "nodes")}
    project.experiment(vary={"seed": [1, 2]}, set={"outputs.nodes.fields": ["position"]})
    flush = tables.Table._flush

    def fail_at_the_end(table: tables.Table) -> None:
        if table._paths[0].endswith("runs.parquet"):
            raise OSError("No space left on device")
        flush(table)

    monkeypatch.setattr(tables.Table, "_flush", fail_at_the_end)
    assert main([*command, "--resume"]) == 1
    assert {name: list(project.table(name=name)["run"]) for name in before} == before


def test_tables_are_not_mixed_after_a_kill_between_two_renames(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    command = ["sweep", project.experiment(vary={"seed": [1]}), "--out", str(project.folder / "out"), "--jobs", "1"]
    assert main([*command, "--csv"]) == 0
    project.experiment(vary={"seed": [1, 2]})
    publish = tables.Table.publish

    def publish_once(table: tables.Table) -> None:
        publish(table)
        raise KeyboardInterrupt

    monkeypatch.setattr(tables.Table, "publish", publish_once)
    assert main([*command, "--resume"]) == 130
    with pytest.raises(ExperimentError, match=r"no usable runs.parquet .*; otherwise write them with .* --resume"):
        load(str(project.folder / "out"))
    monkeypatch.undo()
    assert main([*command, "--resume"]) == 0
    assert sorted({*pd.read_csv(project.folder / "out/series.csv")["seed"]}) == [1, 2]


def test_texts_with_many_lines_are_read_in_linear_time(tmp_path: Path) -> None:
    lines = "\n" * 200_000
    (tmp_path / "run").mkdir()
    (tmp_path / "run/nodes.csv").write_text(f'second,node,text\n0,1,"{lines}"\n')
    began = time.process_time()
    rows = tables._Columns.node_rows(Mock(nodes={"text": pa.string()}, _store=Mock(runs=tmp_path), _node_column=str), Run("run", {}, {}))
    assert list(rows) == [{"second": 0, "node": 1, "text": lines}]
    assert time.process_time() - began < 2


def test_results_cannot_be_in_folders_that_another_sweep_may_delete(project: Project) -> None:
    assert project.sweep(vary={"seed": [1]}).returncode == 0
    (run,) = (project.folder / "out/runs").iterdir()
    for place in (run, run / "again", project.folder / "out/bundle", project.folder / "out/new.part", project.folder / "out/runs/new.part"):
        before = sorted(place.rglob("*")) if place.exists() else []
        result = project.sweep(out=str(place.relative_to(project.folder)), vary={"seed": [1]})
        assert result.returncode == 1
        assert "belongs to a sweep, which may delete it: name another folder with --out" in result.stderr
        assert before == (sorted(place.rglob("*")) if place.exists() else [])


def test_the_name_of_a_results_folder_may_end_like_that_of_an_unfinished_one(project: Project) -> None:
    assert project.sweep(out="results.part", vary={"seed": [1]}).returncode == 0
    result = project.sweep("--resume", out="results.part", vary={"seed": [1]})
    assert result.returncode == 0, result.stderr


def test_results_cannot_be_in_a_folder_with_an_emoji(project: Project) -> None:
    result = project.sweep(out="a\U0001f680", vary={"seed": [1]})
    assert result.returncode == 1
    assert "a\U0001f680' contains an emoji or another character beyond U+FFFF, and the JVM cannot load classes from there: name another" in result.stderr
    assert not (project.folder / "a\U0001f680").exists()


def test_a_dry_run_prints_the_number_of_runs(project: Project) -> None:
    result = project.sweep("--dry-run", **MANY)
    assert result.returncode == 0, result.stderr
    assert re.match(r"16 runs into .*, 2 at once, about \d+ s\n", result.stdout)
    assert not (project.folder / "out").exists()


def test_a_dry_run_whose_trial_fails_prints_no_estimate(project: Project) -> None:
    result = project.sweep("--dry-run", vary={"fields.lamps": [0, 1]})
    assert result.returncode == 1
    assert "failed (failed: the run had no nodes" in result.stderr
    assert "runs into" not in result.stdout


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_dry_run_leaves_no_files(number: signal.Signals, project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    driver = project.start("--dry-run", **MANY)
    while not list(tmp_path.glob("collektive-*/out/logs/trial.txt")):
        assert driver.poll() is None
        time.sleep(0.02)
    driver.send_signal(number)
    driver.communicate(timeout=30)
    assert driver.returncode == 128 + number
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("given", "seed"), [({}, 1), ({"seed": (1 << 64) - 1}, (1 << 64) - 1)])
def test_runs_without_a_manifest_have_a_seed(project: Project, given: dict[str, Any], seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "require_unchanged", lambda *_: None)
    experiment = read(project.experiment(set=given))
    store = Store(str(project.folder / "out"))
    (run,) = experiment.runs()
    os.makedirs(store.runs)
    store.begin(run)
    store.finish(run, Outcome("failed", "no luck"), 1)
    tables.write(experiment, store, False)
    assert list(project.table()["seed"]) == [seed]


def test_tables_are_written_although_another_command_has_removed_the_environment(project: Project) -> None:
    code = """
import os, sys
from collektive_experiments import __main__, read, tables
from collektive_experiments.store import Store
from collektive_experiments.worker import Outcome
experiment, store = read(sys.argv[1]), Store(sys.argv[2])
os.makedirs(store.runs)
for run in experiment.runs():
    store.begin(run)
    store.finish(run, Outcome("failed", "no luck"), 1)
tables.require_unchanged = lambda *_: None
sys.meta_path.clear()
tables.write(experiment, store, True)
"""
    path = project.experiment(vary={"seed": [1, 2]})
    written = subprocess.run([sys.executable, "-c", code, path, str(project.folder / "out")], capture_output=True, text=True)
    assert (written.returncode, written.stderr) == (0, "")
    assert len(project.table()) == 2


@pytest.mark.parametrize(("tick", "censored"), [(0.033333, 5.99994), (0.1, 6)])
def test_a_censored_run_is_observed_until_the_last_row_at_which_it_could_have_converged(
        tick: float, censored: float, project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "require_unchanged", lambda *_: None)
    experiment = read(project.experiment())
    store = Store(str(project.folder / "out"))
    (run,) = experiment.runs()
    os.makedirs(store.runs)
    folder = Path(store.begin(run))
    scenario = {"deltaTime": tick, "converged": {"error": {"from": 0, "seconds": 4}}}
    (folder / "manifest.json").write_text(json.dumps({"scenario": scenario, "end": {"error": -1}, "converged": {"error": None}, "versions": {}}))
    numbers = [*tables.COUNTS, *TIMES]
    # The player accepts a period that lacks less than half a tick, and writes rows of 1 s after 30 ticks of 0.033333 s.
    rows = [f"{round(second * round(1 / tick) * tick, 6):g},-1{',0' * len(numbers)}" for second in range(11)]
    (folder / "metrics.csv").write_text("\n".join([",".join(["second", "error", *numbers]), *rows, ""]))
    store.finish(run, Outcome("complete"), 1)
    tables.write(experiment, store, False)
    assert list(project.table()["censored.error"]) == [censored]


@pytest.mark.slow
def test_a_sweep_stops_if_its_first_runs_fail_in_the_same_way_unless_keep_going(project: Project) -> None:
    keys: dict[str, Any] = {"vary": {"seed": "1-8"}, "set": {"fields.lamps": 0}}
    result = project.sweep(**keys)
    assert result.returncode == 1
    assert "the sweep stopped: its first 5 runs all failed in the same way" in result.stderr
    result = project.sweep("--resume", "--keep-going", **keys)
    assert result.returncode == 1
    assert list(project.table()["status"]) == ["failed"] * 8


def test_runs_that_fail_crash_or_hang_are_reported_and_the_others_complete(project: Project) -> None:
    scene = project.folder / "project/scene/Lamps.cs"
    # With fate 1, the scene throws an exception. With fate 2, it kills its process, and with fate 3, it hangs.
    scene.write_text(scene.read_text().replace("public bool loop;", "public bool loop;\n        public int fate;").replace(
        "for (var i = 0; i < lamps; i++)\n",
        'if (fate == 1) throw new System.InvalidOperationException("no luck");\n'
        '            if (fate == 2) System.Diagnostics.Process.GetCurrentProcess().Kill();\n'
        '            while (fate == 3) System.Threading.Thread.Sleep(10);\n            for (var i = 0; i < lamps; i++)\n', 1))
    keys = {"vary": {"fields.fate": "0-4"}, "set": {"seed": (1 << 53) + 1}}
    result = project.sweep("--time-limit", "8", **keys)
    assert result.returncode == 1
    assert "3 of 5 runs are not complete" in result.stderr
    assert "to repeat the incomplete runs, add --resume" in result.stderr
    runs = project.table().set_index("fields.fate")
    assert list(runs["status"]) == ["complete", "failed", "crashed", "timeout", "complete"]
    assert list(map(str, runs["seed"])) == ["9007199254740993"] * 5
    assert "no luck" in runs.loc[1, "message"]
    assert "SIGKILL" in runs.loc[2, "message"]
    assert runs.loc[0, "digest"] == runs.loc[4, "digest"]
    assert runs["digest"].notna().sum() == 2
    await_no_worker(project)


@pytest.mark.slow  # an acceptance test examines a single run
@pytest.mark.parametrize(("placement", "end"), [
    ("InProcess", ""), ("OwnProcess", ""), ("OwnProcess", "System.Diagnostics.Process.GetCurrentProcess().Kill();")])
def test_a_sweep_leaves_no_sockets_of_the_jvm(project: Project, placement: str, end: str) -> None:
    pids = project.folder / "pids"
    pids.mkdir()
    source = project.folder / "project/scene/Lamps.cs"
    source.write_text(source.read_text().replace("data.Brightness = Brightness;", "data.Brightness = Brightness;\n            "
                      "var child = Collektive.Bridge.Jvm.GetStatus().Process;"
                      f'System.IO.File.WriteAllText("{pids}/" + (child == 0 ? System.Diagnostics.Process.GetCurrentProcess().Id : child), "");' + end))
    assert project.sweep(vary={"seed": "1-3"}, set={"jvm.placement": placement}).returncode == (1 if end else 0)
    assert len(list(pids.iterdir())) >= 3
    assert [pid.name for pid in pids.iterdir() if os.path.lexists(f"/tmp/.java_pid{pid.name}")] == []


@pytest.mark.slow  # the suite chaos kills sweeps at random moments, too
def test_a_sweep_killed_with_sigkill_resumes_to_the_same_table(project: Project) -> None:
    driver = project.start(**MANY)
    await_runs(project, 3)
    os.kill(workers(project)[0], signal.SIGKILL)
    await_runs(project, 6)
    driver.kill()
    driver.communicate()
    await_no_worker(project)
    resumed = project.sweep("--resume", **MANY)
    assert resumed.returncode == 0, resumed.stderr
    assert "of 16 runs are already complete" in resumed.stderr
    whole = project.sweep(out="whole", **MANY)
    assert whole.returncode == 0, whole.stderr
    assert project.digests() == project.digests("whole")
    assert list(project.table()["run"]) == list(project.table("whole")["run"])
    assert list(project.table(name="series")["agreeing"]) == list(project.table("whole", "series")["agreeing"])


def test_ctrl_c_keeps_completed_runs_and_writes_their_tables(project: Project) -> None:
    driver = project.start(**MANY)
    await_runs(project, 3)
    driver.send_signal(signal.SIGINT)
    _, errors = driver.communicate(timeout=30)
    assert driver.returncode == 130
    assert "interrupted; " in errors
    assert 3 <= len(project.table()) < 16
    assert set(project.table()["status"]) == {"complete"}
    await_no_worker(project)


def can_mount() -> bool:
    return subprocess.run(["unshare", "--mount", "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode == 0


@pytest.mark.slow  # the suite chaos fills disks, too
@pytest.mark.skipif(not can_mount(), reason="no small disk can be mounted here")
def test_a_full_disk_stops_the_sweep_and_it_can_be_resumed(project: Project, lamps: Project) -> None:
    disk = project.folder / "disk"
    disk.mkdir()
    keep = project.folder / "out"
    bundle = sum(file.stat().st_size for file in (lamps.folder / "out/bundle").rglob("*") if file.is_file())
    # The disk has space for the inputs and for some runs. A run takes 0.1 MB.
    size = f"{bundle // 1024 + 1500}k"
    script = 'mount -t tmpfs -o size="$1" none "$2" || exit 99; shift; disk=$1; keep=$2; shift 2; "$@"; code=$?; cp -r "$disk/out" "$keep"; exit $code'
    nodes = {"fields": ["position"], "interval": 0.1}
    experiment = project.experiment(vary={"seed": "1-24"}, set={"seconds": 40, "outputs.interval": 0.1, "outputs.nodes": nodes})
    command = project.command("sweep", experiment, "--out", str(disk / "out"), "--jobs", "2")
    full = subprocess.run(["unshare", "--mount", "bash", "-c", script, "bash", size, str(disk), str(keep), *command], capture_output=True, text=True,
                          timeout=120)
    assert full.returncode == 1, full.stderr
    assert "No space left on device" in full.stderr or "is full" in full.stderr
    done = sum(json.loads(path.read_text())["status"] == "complete" for path in keep.glob("runs/*/run.json"))
    assert 0 < done < 24
    resumed = subprocess.run(project.command("sweep", experiment, "--out", str(keep), "--resume"), capture_output=True, text=True, timeout=120)
    assert resumed.returncode == 0, resumed.stderr
    assert f"{done} of 24 runs are already complete" in resumed.stderr
    assert len(set(project.table()["run"])) == 24


def code_block(language: str) -> str:
    """Returns the first code block in the given language on the page about experiments."""
    return str(re.findall(rf"(?ms)^```{language}\n(.*?)^```$", (ROOT / "Documentation~/experiments.md").read_text())[0])


@pytest.mark.slow
def test_the_example_study_produces_its_figures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    experiment = json.loads((GRADIENTS / "experiment.json").read_text())
    assert experiment == json.loads(code_block("json"))
    experiment["scenario"] = str(GRADIENTS / "scenario.json")
    experiment["vary"] |= {"network.loss": [0, 0.4], "seed": "1-3"}
    (tmp_path / "experiment.json").write_text(json.dumps(experiment))
    out = tmp_path / "out/gradients"
    for words in (["sweep", str(tmp_path / "experiment.json"), "--out", str(out)], ["plot", str(out)]):
        result = subprocess.run([COLLEKTIVE, *words], capture_output=True, text=True, timeout=300)
        assert result.returncode == 0, result.stderr
    results = load(str(out))
    effects = compare(results, "converged.error", "program").set_index(["network.loss", "a", "b"])
    # Without message loss, all runs converge. With loss, the program that sends only distances takes longer than the program that sends paths.
    assert results.runs["converged.error"].notna().all()
    assert effects.loc[(0.4, "path-vector", "bellman-ford"), "difference"] > 0
    assert {"error-time.svg", "error-time.pdf", "error-end.svg", "reached-time.svg", "converged.error-end.pdf",
            "converged.error-line-network.loss-program.pdf", "converged.error-box-network.loss-program.txt"} <= set(os.listdir(out / "figures"))
    page = (out / "figures.html").read_text()
    assert page.count("<svg") == 7
    assert "95 % bootstrap interval of 3 runs per configuration" in page
    # The Python code of the page runs in the folder of the sweep.
    monkeypatch.chdir(tmp_path)
    names: dict[str, str] = {}
    exec(code_block("python"), names)
    assert "error" in names["caption"]


def test_the_notebook_runs(lamps: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    notebook = json.loads((ROOT / "experiments/example.ipynb").read_text())
    monkeypatch.setenv("SWEEP", str(lamps.folder / "out"))
    names: dict[str, object] = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)
    assert len(names["results"].runs) == 8  # type: ignore[attr-defined]


def test_the_package_can_be_installed_with_pip(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "pip", "install", "--no-deps", "--no-build-isolation", "--no-index", "--target", str(tmp_path), str(ROOT / "experiments")]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "collektive_experiments/__init__.py").exists()


@pytest.mark.slow
def test_a_slurm_array_job_gives_the_same_digests(lamps: Project) -> None:
    keys = {**EIGHT, "vary": {**EIGHT["vary"], "fields.lamps": [5]}}
    result = lamps.sweep("--slurm", out="slurm", **keys)
    assert result.returncode == 0, result.stderr
    script = lamps.folder / "slurm/slurm.sh"
    checked = subprocess.run([ROOT / "build/python/bin/shellcheck", script], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
    text = script.read_text()
    assert "#SBATCH --array=0-3\n" in text
    assert "#SBATCH --cpus-per-task=2\n" in text
    for index in (0, 1, 3):
        subprocess.run([script], check=True, env={**os.environ, "SLURM_ARRAY_TASK_ID": str(index)})
    with Store(str(lamps.folder / "slurm")) as store, files.open_log(str(lamps.folder / "slurm/logs/task-2.txt")) as log:
        store.lock(shared=True)
        assert "another sweep writes to" in lamps.sweep("--resume", out="slurm", **keys).stderr
        fcntl.flock(log, fcntl.LOCK_EX)
        twice = subprocess.run([script], capture_output=True, text=True, env={**os.environ, "SLURM_ARRAY_TASK_ID": "2"})
        assert (twice.returncode, "task 2 of" in twice.stderr) == (1, True), twice.stderr
    for index in ("4", "-1"):
        unknown = subprocess.run([script], capture_output=True, text=True, env={**os.environ, "SLURM_ARRAY_TASK_ID": index})
        assert (unknown.returncode, f"the job has no task {index}" in unknown.stderr, "Traceback" in unknown.stderr) == (1, True, False), unknown.stderr
    # With --resume, the sweep itself executes the runs of tasks that did not run.
    resumed = lamps.sweep("--resume", out="slurm", **keys)
    assert resumed.returncode == 0, resumed.stderr
    assert "3 of 4 runs are already complete" in resumed.stderr
    digests = lamps.digests()
    assert lamps.digests("slurm") == {run: digest for run, digest in digests.items() if "lamps=5" in run}


def test_a_manifest_that_vanishes_during_the_sweep_is_reported(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "require_unchanged", lambda *_: None)
    experiment = read(project.experiment(vary={"seed": [1]}))
    (run,) = experiment.runs()
    store = Store(str(project.folder))
    folder = project.folder / "runs" / run.name
    folder.mkdir(parents=True)
    (folder / "run.json").write_text(json.dumps({"name": run.name, "status": "complete", "message": "", "files": {"manifest.json": "", "metrics.csv": ""}}))
    (folder / "metrics.csv").write_text(",".join(["second", *tables.COUNTS, *TIMES]) + "\n")
    with pytest.raises(ExperimentError, match=f"the manifest of '{run.name}' was changed: repeat the run with --resume"):
        tables.write(experiment, store, False)


def test_runs_on_different_jvms_are_reported(project: Project, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "require_unchanged", lambda *_: None)
    experiment = read(project.experiment(vary={"seed": [1, 2, 3]}))
    for run, jvm in zip(experiment.runs(), ("Java 17", "Java 25", "Java 25")):
        folder = project.folder / "runs" / run.name
        folder.mkdir(parents=True)
        (folder / "manifest.json").write_text(json.dumps({"end": {}, "converged": {}, "versions": {"jvm": jvm, "os": run.name}}))
        (folder / "metrics.csv").write_text(",".join(["second", *tables.COUNTS, *TIMES]) + "\n")
        hashes = {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in ("manifest.json", "metrics.csv")}
        (folder / "run.json").write_text(json.dumps({"name": run.name, "status": "complete", "message": "", "files": hashes}))
    tables.write(experiment, Store(str(project.folder)), False)
    assert [line for line in capsys.readouterr().err.splitlines() if "version" in line] == [
        "collektive: the runs have 2 values of version.jvm ('Java 17', 'Java 25'), so results of functions such as Math.sin can differ between them"]


@pytest.mark.parametrize("header", [
    "", ",".join(["second", "m", *tables.COUNTS, *TIMES[1:]]), ",".join(["second", *tables.COUNTS, "retried", *TIMES])])
def test_metrics_of_another_version_are_rejected_before_other_runs(header: str, project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    for place, name in ((sweep, "prepare"), (sweep, "check_keys"), (tables, "require_unchanged"), (Store, "open"), (Store, "write_settings")):
        monkeypatch.setattr(place, name, lambda *_: None)
    experiment = read(project.experiment(vary={"seed": [1, 2]}))
    run = next(iter(experiment.runs()))
    folder = project.folder / "runs" / run.name
    folder.mkdir(parents=True)
    (folder / "manifest.json").write_text('{"end": {"m": 9}, "converged": {}, "versions": {}}')
    (folder / "metrics.csv").write_text(f"{header}\n0,9" + ",1" * header.count(",") + "\n" if header else "")
    hashes = {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in ("manifest.json", "metrics.csv")}
    (folder / "run.json").write_text(json.dumps({"name": run.name, "status": "complete", "message": "", "files": hashes}))
    store = Store(str(project.folder))
    for read_run in (lambda: sweep.begin(experiment, store, True, False), lambda: tables.write(experiment, store, False)):
        with pytest.raises(ExperimentError, match=f"metrics.csv of '{run.name}' is damaged or of another version"):
            read_run()
