"""Tests the search for parameter values."""
import argparse
import contextlib
import csv
import json
import math
import os
import shutil
import sqlite3
import subprocess
from typing import Any, cast
from unittest.mock import Mock

import pytest
from conftest import Project
from optuna.storages import RDBStorage

from collektive_experiments import ExperimentError, load, read
from collektive_experiments import search as searching
from collektive_experiments import tune as tuning
from collektive_experiments.experiment import Run
from collektive_experiments.search import check_search, read_search
from collektive_experiments.store import Store
from collektive_experiments.worker import Outcome

TUNE: dict[str, Any] = {"metric": "agreeing", "direction": "maximize", "trials": 3,
                        "parameters": {"fields.lamps": {"from": 3, "to": 6}, "network.loss": [0, 0.5]}}


def tune(project: Project, *arguments: str, out: str = "out", **changes: Any) -> subprocess.CompletedProcess[str]:
    path = project.experiment(vary={"seed": "1-2"}, set={"seconds": 1}, tune={**TUNE, **changes})
    command = project.command("tune", path, "--out", str(project.folder / out), "--jobs", "2", *arguments)
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def test_a_search_finds_the_best_trial_and_continues(project: Project) -> None:
    first = tune(project)
    assert first.returncode == 0, first.stderr
    again = tune(project)
    assert again.returncode == 1
    assert "continue it with --resume" in again.stderr
    other = tune(project, "--resume", metric="dropped", direction="minimize")
    assert other.returncode == 1
    second = tune(project, "--resume", "--trials", "5")
    assert second.returncode == 0, second.stderr
    with open(project.folder / "out/trials.csv") as file:
        rows = list(csv.DictReader(file))
    assert [row["trial"] for row in rows] == ["0", "1", "2", "3", "4"]
    best = max(rows, key=lambda row: float(row["agreeing"]))
    assert f"5 trials, best agreeing {float(best['agreeing']):g} in trial" in second.stdout
    # The value of a trial is the mean over its runs.
    for row in rows:
        ends = [json.loads((folder / "manifest.json").read_text()) for folder in (project.folder / "out/runs").iterdir()]
        values = [end["end"]["agreeing"] for end in ends if end["scenario"]["fields"]["lamps"] == int(row["fields.lamps"])
                  and end["scenario"]["network"]["loss"] == float(row["network.loss"])]
        assert len(values) == 2
        assert float(row["agreeing"]) == pytest.approx(sum(values) / 2)
    with pytest.raises(ExperimentError, match="is the folder of a search"):
        load(str(project.folder / "out"))


def test_trials_without_a_value_are_counted(project: Project) -> None:
    path = project.experiment(set={"seconds": 1, "metrics": {"few": "nullif(count(*), 4)"}},
                              tune={"metric": "few", "trials": 4, "parameters": {"fields.lamps": [3, 4]}})
    result = subprocess.run(project.command("tune", path, "--out", str(project.folder / "out")), capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    with open(project.folder / "out/trials.csv") as file:
        missing = sum(row["few"] == "" for row in csv.DictReader(file))
    assert 0 < missing < 4
    assert f"collektive: {missing} of 4 trials have no value of 'few'" in result.stderr
    assert f"{4 - missing} trials, best few 3 in trial" in result.stdout


@pytest.mark.slow
def test_trials_without_runs_are_not_continued_with_other_inputs(project: Project) -> None:
    assert tune(project, "--trials", "1").returncode == 0
    shutil.rmtree(project.folder / "out/runs")
    again = tune(project, "--trials", "1")
    assert again.returncode == 1
    assert "study.db' has trials whose runs were deleted" in again.stderr
    (project.folder / "out/study.db").unlink()
    assert tune(project, "--trials", "1").returncode == 0


def test_a_storage_of_a_search_with_other_inputs_is_refused(project: Project) -> None:
    assert tune(project, "--trials", "2").returncode == 0
    program = next((project.folder / "project/programs").glob("*.kt"))
    program.write_text(program.read_text() + "// changed\n")
    assert tune(project, "--trials", "1", out="other").returncode == 0
    shutil.copy(project.folder / "out/study.db", project.folder / "other")
    again = tune(project, "--trials", "2", "--resume", out="other")
    assert again.returncode == 1
    assert "study.db' was copied from a search with other inputs" in again.stderr


@pytest.mark.parametrize(("change", "message"), [
    ("update trial_values set value = value + 1", "study.db' differs from the runs of trial 0: delete study.db and continue"),
    ("update trial_params set param_value = param_value / 2", "study.db' differs from the runs of trial 0: delete study.db and continue"),
    pytest.param("update trial_params set distribution_json = '{'", "study.db' cannot be read or written: ", marks=pytest.mark.slow)])
def test_a_damaged_storage_is_an_error(project: Project, change: str, message: str) -> None:
    first = tune(project, "--trials", "1")
    storage = project.folder / "out/study.db"
    with contextlib.closing(sqlite3.connect(storage)) as database, database:
        database.execute(change)
    again = tune(project, "--trials", "1", "--resume")
    assert again.returncode == 1
    assert message in again.stderr.splitlines()[-1]
    storage.unlink()
    assert tune(project, "--trials", "1", "--resume").stdout == first.stdout


def test_the_storage_is_in_the_output_folder_only(project: Project) -> None:
    # Characters that are special in a URL.
    out = "a?b%20#c"
    result = tune(project, "--trials", "1", out=out)
    assert result.returncode == 0, result.stderr
    storage = project.folder / out / "study.db"
    assert storage.is_file()
    assert not (project.folder / "a").exists()
    content = storage.read_bytes()
    storage.rename(project.folder / "elsewhere.db")
    storage.symlink_to(project.folder / "elsewhere.db")
    assert "is a symbolic link" in tune(project, "--resume", "--trials", "2", out=out).stderr
    assert (project.folder / "elsewhere.db").read_bytes() == content
    storage.unlink()
    # A copy that `cp -al` made.
    storage.hardlink_to(project.folder / "elsewhere.db")
    assert "is a hard link" in tune(project, "--resume", "--trials", "2", out=out).stderr
    assert (project.folder / "elsewhere.db").read_bytes() == content
    storage.unlink()
    storage.write_bytes(content[:5000])
    damaged = tune(project, "--resume", "--trials", "2", out=out)
    assert (damaged.returncode, damaged.stderr.count("\n")) == (1, 1), damaged.stderr
    assert f"'{storage}' cannot be read or written: database disk image is malformed" in damaged.stderr


@pytest.mark.parametrize(("metric", "value"), [("two", 2), ("odd", math.nan), ("converged.two", 0.5), ("converged.three", 9.3), ("one", math.nan),
                                               ("converged.one", math.nan)])
def test_only_the_duration_of_runs_that_do_not_converge_replaces_a_value(project: Project, metric: str, value: float) -> None:
    run = next(read(project.experiment()).runs())
    store = Store(str(project.folder / "out"))
    part = store.runs + "/" + run.name + ".part"
    os.makedirs(part)
    manifest = {"end": {"two": 2, "odd": "Infinity"}, "converged": {"two": 0.5, "three": None}, "ticks": 4,
                "scenario": {"seconds": 9.25, "deltaTime": 0.30000001192092896}}
    for name, content in (("manifest.json", json.dumps(manifest)), ("metrics.csv", ""), (".collektive-sweep", "")):
        with open(f"{part}/{name}", "w") as file:
            file.write(content)
    store.finish(run, Outcome("complete"), 1)
    assert tuning._value(store, run, metric) == pytest.approx(value, nan_ok=True)


def test_a_search_with_other_runs_is_another_search(project: Project) -> None:
    fixed = {"seconds": 1, "threads": 2}
    keys: list[dict[str, Any]] = [
        {"vary": {"seed": "1-2"}, "set": fixed}, {"vary": {"seed": "1-2"}, "set": dict(reversed(fixed.items()))}, {"vary": {"seed": "1-3"}, "set": fixed},
        {"vary": {"seed": "1-2"}, "set": {**fixed, "seconds": 2}}, {"vary": {}, "zip": {"seed": "1-2"}, "set": fixed}]
    first, *others = [read_search(read(project.experiment(**values, tune=TUNE))).identity for values in keys]
    assert [first == other for other in others] == [True, False, False, False]


def test_a_search_that_was_killed_at_its_start_keeps_its_direction(project: Project) -> None:
    store = Store(str(project.folder))
    os.mkdir(store.runs)
    with pytest.MonkeyPatch.context() as patch, pytest.raises(SystemExit):
        patch.setattr(RDBStorage, "set_study_user_attr", Mock(side_effect=SystemExit))
        tuning._study(read_search(read(project.experiment(tune=TUNE))), store)
    with pytest.raises(ExperimentError, match="belongs to another search"):
        tuning._study(read_search(read(project.experiment(tune={**TUNE, "direction": "minimize"}))), store)


def test_a_range_of_one_step_is_searched(project: Project) -> None:
    # In binary numbers, 1.4 - 1.1 is less than 0.3.
    values = {"from": 1.1, "to": 1.4, "step": 0.3}
    assert read_search(read(project.experiment(tune={**TUNE, "parameters": {"fields.lamps": values}}))).parameters == {"fields.lamps": values}


@pytest.mark.parametrize(("changes", "message"), [
    ({"metric": "agreement"}, "'tune.metric' is 'agreement', which does not exist; existing metrics: agreeing"),
    ({"parameters": {}}, "'tune.parameters' must be an object with the values of each key"),
    ({"parameters": {"seed": [1, 2]}}, "'seed' is in 'tune', and also in 'vary', 'zip' or 'set'"),
    ({"parameters": {"fields.lamps": [3, 3.0]}}, "must be at least two different strings, numbers or booleans"),
    ({"parameters": {"fields.lamps": {"from": 3, "to": 3}}}, "'from' must be below 'to'"),
    ({"parameters": {"fields.lamps": {"from": 3, "too": 5}}}, "must be a list, or an object with the numbers 'from' and 'to'"),
    ({"parameters": {"fields.lamps": {"from": 3, "to": 2 ** 53 + 1}}}, "'tune.parameters.fields.lamps': whole numbers in a range must be from -2^53 to 2^53"),
    ({"parameters": {"fields.lamps": {"from": 3, "to": 5, "step": 4}}}, "'step' must be at most the difference of 'to' and 'from'"),
    ({"parameters": {"fields.lamps": {"from": -1e308, "to": 1e308}}}, "the difference of 'to' and 'from', which must be finite"),
    ({"parameters": {"fields.lmps": [3, 4]}}, "no public field 'lmps'"),
    ({"parameters": {"programs": ["a", "b"]}}, "'programs' cannot vary"),
    ({"direction": "up"}, "'tune.direction' is \"up\"; it must be one of: minimize, maximize"),
    ({"trials": 0}, "'tune.trials' is 0; it must be a whole number above 0"),
    ({"sampler": "x"}, "unknown key 'tune.sampler'"),
])
def test_an_invalid_search_is_refused_with_its_line(project: Project, changes: dict[str, Any], message: str) -> None:
    result = tune(project, **changes)
    assert result.returncode == 1
    assert message in result.stderr
    assert "experiment.json:" in result.stderr


@pytest.mark.parametrize(("changes", "message"), [
    ({"sampler": "x"}, "unknown key 'tune.sampler'"),
    pytest.param({"parameters": {"fields.lmps": [3, 4]}}, "no public field 'lmps'", marks=pytest.mark.slow),
])
def test_a_dry_run_of_a_sweep_checks_the_search(project: Project, changes: dict[str, Any], message: str) -> None:
    result = project.sweep("--dry-run", vary={"seed": "1-2"}, set={"seconds": 1}, tune={**TUNE, **changes})
    assert (result.returncode, message in result.stderr) == (1, True), result.stderr


def test_an_interrupted_search_continues_its_trials(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    experiment = read(project.experiment(vary={"seed": "1-2"}, tune=TUNE))
    calls: list[tuple[list[str], float]] = []

    def search(code: int, resume: bool) -> int:
        def drive(store: Store, total: int, todo: Any, pool: Any, jobs: int, max_equal_failures: float) -> int:
            calls.append(([run.name for run, _ in todo], max_equal_failures))
            return code

        monkeypatch.setattr(tuning, "drive", drive)
        options = argparse.Namespace(resume=resume, trust_jvm=False, trials=None, jobs=2, keep_going=False)
        with Store(str(project.folder / "out")) as store:
            return tuning.tune(experiment, read_search(experiment), store, cast(Any, lambda: None), options)

    for name in ("prepare", "check_search", "require_unchanged"):
        monkeypatch.setattr(tuning, name, lambda *_: None)
    # Their sum is infinite.
    monkeypatch.setattr(tuning, "_value", lambda *_: 1.5e308)
    assert search(130, resume=False) == 130
    assert search(0, resume=True) == 0
    assert calls[0] == calls[1]
    # After the first trials, failures are results of the search.
    assert [limit for _, limit in calls] == [5, 5, math.inf]
    lines = (project.folder / "out/trials.csv").read_text().splitlines()
    assert [line.split(",")[:2] for line in lines] == [["trial", "agreeing"], *([str(trial), "1.5e+308"] for trial in range(3))]


def test_a_killed_search_continues_with_the_same_trials(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    steps = {"from": 0, "to": 9, "step": 4}
    experiment = read(project.experiment(vary={"seed": "1-2"}, tune={**TUNE, "trials": 12, "parameters": {"network.loss": {"from": 0, "to": 1}, "x": steps}}))
    options = argparse.Namespace(resume=True, trust_jvm=False, trials=None, jobs=3, keep_going=False)

    def drive(store: Store, total: int, todo: list[tuple[Run, bool]], *_: Any) -> int:
        for folder in (store.bundle, *(os.path.join(store.runs, run.name) for run, _ in todo)):
            os.makedirs(folder, exist_ok=True)
        return 0

    for name in ("prepare", "check_search", "require_unchanged"):
        monkeypatch.setattr(tuning, name, lambda *_: None)
    monkeypatch.setattr(tuning, "drive", drive)
    monkeypatch.setattr(tuning, "_value", lambda store, run, metric: run.values["network.loss"] * (run.values["x"] + 1))

    def search(out: str, method: str, kill_at: int) -> list[list[str]]:
        """Kills the search before the given call of a method of its storage, and continues it. Returns the values of its trials."""
        calls = 0
        original = getattr(RDBStorage, method)

        def call(*arguments: Any, **named: Any) -> Any:
            nonlocal calls
            calls += 1
            if calls == kill_at:
                raise SystemExit
            return original(*arguments, **named)

        with monkeypatch.context() as patch:
            patch.setattr(RDBStorage, method, call)
            for _ in range(2):
                with Store(str(project.folder / out)) as store, contextlib.suppress(SystemExit):
                    tuning.tune(experiment, read_search(experiment), store, cast(Any, lambda: None), options)
        with open(project.folder / out / "trials.csv") as file:
            return [row[1:] for row in csv.reader(file)]

    undisturbed = search("undisturbed", "set_trial_param", 0)
    assert len(undisturbed) == 13
    # In the proposal of a trial, and between the results of two trials.
    for method, kill_at in (("set_trial_param", 22), ("set_trial_state_values", 8)):
        assert search(f"{method}-{kill_at}", method, kill_at) == undisturbed


@pytest.mark.parametrize("keys", [{"set": {"converged": {"agreeing": {"from": 3}}}}, {"set": {"converged.agreeing": {"from": 3}}},
                                  {"vary": {"converged.agreeing.from": [3, 4]}}])
def test_the_metric_can_be_a_convergence_time_of_the_experiment(project: Project, keys: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    experiment = read(project.experiment(**keys, tune={**TUNE, "metric": "converged.agreeing"}))
    monkeypatch.setattr(searching, "check_keys", lambda *_: ["agreeing"])
    check_search(experiment, read_search(experiment), Store(""), False)
