"""Searches for the parameter values with the best metric. Optuna proposes values, and the workers of sweeps execute the runs."""
import argparse
import csv
import json
import math
import os
import statistics
import sys
import warnings
from collections.abc import Callable
from typing import Any

import optuna
import sqlalchemy
from optuna.trial import TrialState

from .bundle import prepare, require_unchanged
from .experiment import Experiment, Run, name_of, text
from .figure_options import CONVERGED
from .files import write
from .positions import ExperimentError
from .search import Search, check_search, is_int
from .store import PART, Store
from .sweep import MAX_EQUAL_FAILURES, Pool, drive

STUDY = "tune"


def tune(experiment: Experiment, search: Search, store: Store, pool: Callable[[], Pool], options: argparse.Namespace) -> int:
    """Executes the remaining trials, up to `jobs` at the same time. Returns the exit code."""
    try:
        return _tune(experiment, search, store, pool, options)
    except (sqlalchemy.exc.SQLAlchemyError, optuna.exceptions.StorageInternalError) as error:
        raise _unreadable(store, error) from error


def _unreadable(store: Store, error: Exception) -> ExperimentError:
    reason = error.__cause__ or str(error) or type(error).__name__
    return ExperimentError(f"'{os.path.join(store.folder, 'study.db')}' cannot be read or written: {reason}; if it is damaged, delete it and continue "
                           "with --resume")


def _tune(experiment: Experiment, search: Search, store: Store, pool: Callable[[], Pool], options: argparse.Namespace) -> int:
    store.open(experiment, options.resume)
    prepare(experiment.scenario, store.bundle, options.trust_jvm, experiment.runtimes)
    check_search(experiment, search, store, options.trust_jvm)
    study = _study(search, store)
    folders = {name.removesuffix(PART) for name in os.listdir(store.runs)}
    proposed = [(trial, _runs(experiment, trial)) for trial in _trials(study, search)]
    others = folders - {run.name for _, runs in proposed for run in runs}
    for trial, runs in proposed:
        if trial.state != TrialState.COMPLETE:
            continue
        # SQLite has no checksums. Runs of finished trials may have been deleted, and are not repeated. Runs with other names show that values have changed.
        is_changed = bool(others) and not any(run.name in folders for run in runs)
        if is_changed or (all(map(store.is_intact, runs)) and trial.value != _mean(search, store, runs)):
            raise ExperimentError(f"'{os.path.join(store.folder, 'study.db')}' differs from the runs of trial {trial.number}: delete study.db and "
                                  "continue with --resume")
    store.write_settings()
    total = options.trials or search.trials
    distributions = {key: _distribution(value) for key, value in search.parameters.items()}
    code = 0
    while code == 0 and (left := total - (finished := len(_finished(study, search)))) > 0:
        # Trials of an interrupted search are continued first, in the same groups as without the interruption, because proposals depend on finished trials.
        count = min(left, options.jobs - finished % options.jobs)
        trials: list[Any] = _trials(study, search, TrialState.RUNNING)[:count]
        trials += [_ask(study, search, distributions) for _ in range(count - len(trials))]
        # Runs are collected by name, because different trials may propose the same values.
        groups = [_runs(experiment, trial) for trial in trials]
        every = {run.name: run for group in groups for run in group}
        todo = [(run, False) for run in every.values() if not store.is_complete(run)]
        if todo:
            is_limited = not options.keep_going and not finished
            code = drive(store, len(todo), todo, pool(), options.jobs, MAX_EQUAL_FAILURES if is_limited else math.inf)
        if code >= 128:
            break
        code = 0
        for trial, group in zip(trials, groups, strict=True):
            mean = _mean(search, store, group)
            if math.isnan(mean):
                study.tell(trial.number, state=TrialState.FAIL)
            else:
                study.tell(trial.number, mean)
    require_unchanged(store.bundle)
    _write(study, search, os.path.join(store.folder, "trials.csv"))
    finished_trials = _finished(study, search)
    done = [trial for trial in finished_trials if trial.value is not None]
    if not done and code >= 128:
        return code
    if not done:
        raise ExperimentError(f"no trial has a value of '{search.metric}'; the messages are in '{store.runs}'")
    if len(done) < len(finished_trials):
        print(f"collektive: {len(finished_trials) - len(done)} of {len(finished_trials)} trials have no value of '{search.metric}', because it is not finite "
              "or missing in one of their runs, or one of them failed", file=sys.stderr)
    print(f"{len(done)} trials, best {search.metric} {text(study.best_value)} in trial {study.best_trial.number}:")
    for key, value in study.best_params.items():
        print(f"  {key} = {text(value)}")
    return code


def _distribution(values: Any) -> optuna.distributions.BaseDistribution:
    if isinstance(values, list):
        return optuna.distributions.CategoricalDistribution(values)
    low, high, step, log = values["from"], values["to"], values.get("step"), values.get("log", False)
    with warnings.catch_warnings():
        # Optuna warns if `step` does not divide the range, and reduces `to`.
        warnings.simplefilter("ignore")
        if is_int(low) and is_int(high) and (step is None or is_int(step)):
            return optuna.distributions.IntDistribution(low, high, log=log, step=step or 1)
        return optuna.distributions.FloatDistribution(low, high, log=log, step=step)


def _study(search: Search, store: Store) -> optuna.Study:
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    path = os.path.abspath(os.path.join(store.folder, "study.db"))
    if os.path.islink(path):
        raise ExperimentError(f"'{path}' is a symbolic link; remove it, or name another folder with --out")
    # SQLite writes to the file itself, so the search would also change a copy that `cp -al` made.
    if os.path.exists(path) and os.stat(path).st_nlink > 1:
        raise ExperimentError(f"'{path}' is a hard link: the search would also change its other names; replace it by a copy")
    # The folder's name may contain characters that are special in a URL.
    storage = sqlalchemy.URL.create("sqlite", database=path).render_as_string()
    try:
        study = optuna.create_study(storage=storage, study_name=STUDY, direction=search.direction, load_if_exists=True)
        study.get_trials()
    # Optuna raises these errors for values that it cannot decode.
    except (ValueError, LookupError, TypeError, AssertionError) as error:
        raise _unreadable(store, error) from error
    former = study.user_attrs.setdefault("search", search.identity) if "search" in study.user_attrs else search.identity
    # If the process is killed before it writes this attribute, only the direction is in the file.
    if former != search.identity or study.direction.name.lower() != search.direction:
        raise ExperimentError(f"'{store.folder}' belongs to another search: its metric, direction, parameters or keys of runs differ; "
                              "name another folder with --out")
    if _finished(study, search) and not os.listdir(store.runs):
        # The bundle was created again, and its inputs may differ from those of the deleted runs.
        raise ExperimentError(f"'{path}' has trials whose runs were deleted: delete this file, too, or name another folder with --out")
    if _finished(study, search) and study.user_attrs.get("inputs", store.inputs) != store.inputs:
        raise ExperimentError(f"'{path}' was copied from a search with other inputs: delete it and continue with --resume")
    study.set_user_attr("search", search.identity)
    study.set_user_attr("inputs", store.inputs)
    for trial in study.get_trials(states=(TrialState.RUNNING,)):
        # The search was killed while it proposed this trial.
        if trial.params.keys() != search.parameters.keys():
            study.tell(trial.number, state=TrialState.FAIL)
    return study


def _trials(study: optuna.Study, search: Search, *states: TrialState) -> list[optuna.trial.FrozenTrial]:
    """Returns the trials in any of these states, or all trials without states. Omits trials that were not completely proposed."""
    return [trial for trial in study.get_trials(deepcopy=False, states=states or None) if trial.params.keys() == search.parameters.keys()]


def _finished(study: optuna.Study, search: Search) -> list[optuna.trial.FrozenTrial]:
    return _trials(study, search, TrialState.COMPLETE, TrialState.FAIL)


def _ask(study: optuna.Study, search: Search, distributions: dict[str, optuna.distributions.BaseDistribution]) -> optuna.Trial:
    """Proposes the values of a trial. The seed is the number of earlier trials, so a resumed search proposes the same values as an uninterrupted one."""
    study.sampler = optuna.samplers.TPESampler(seed=len(_trials(study, search)), constant_liar=True)
    return study.ask(distributions)


def _runs(experiment: Experiment, trial: Any) -> list[Run]:
    """Returns the runs of a trial."""
    runs = []
    for run in experiment.runs():
        values = {**trial.params, **run.values}
        settings = experiment.settings(values)
        runs.append(Run(name_of(values, settings), values, settings))
    return runs


def _mean(search: Search, store: Store, runs: list[Run]) -> float:
    """Returns the mean of the metric over runs, or NaN if one of them has no value."""
    return statistics.mean(_value(store, run, search.metric) for run in runs)


def _value(store: Store, run: Run, metric: str) -> float:
    """Returns the value of a metric at the end of a run, or NaN if it has none. The convergence time of a run without convergence is its whole duration."""
    if not store.is_complete(run):
        return math.nan
    with open(os.path.join(store.runs, run.name, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    if metric in manifest["end"]:
        value = float(manifest["end"][metric])
        return value if math.isfinite(value) else math.nan
    name = metric.removeprefix(CONVERGED)
    if name == metric or name not in manifest["converged"]:
        return math.nan
    time = manifest["converged"][name]
    if time is None:
        # The run may have ended early. Its duration is a whole number of ticks, whose length has seven digits.
        scenario = manifest["scenario"]
        tick = float(f"{scenario['deltaTime']:.7g}")
        time = round(max(1, round(scenario["seconds"] / tick)) * tick, 6)
    return float(time)


def _write(study: optuna.Study, search: Search, path: str) -> None:
    """Writes all finished trials to a CSV file."""
    lines: list[str] = []
    writer = csv.writer(argparse.Namespace(write=lines.append), lineterminator="\n")
    writer.writerow(["trial", search.metric, *search.parameters])
    for trial in _finished(study, search):
        writer.writerow([trial.number, "" if trial.value is None else trial.value, *(trial.params[key] for key in search.parameters)])
    write(path, "".join(lines))
