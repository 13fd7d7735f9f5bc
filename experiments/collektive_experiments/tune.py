"""Searches for the parameter values with the best metric. Optuna proposes values, and the workers of sweeps execute the runs."""
import argparse
import csv
import json
import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import optuna
import sqlalchemy

from .bundle import prepare
from .experiment import Experiment, Run, name_of, reject_fixed_key, text
from .figure_options import CONVERGED
from .files import write
from .positions import ExperimentError, Located
from .store import Store
from .sweep import MAX_EQUAL_FAILURES, Pool, check_keys, drive

TRIALS = 50
DIRECTIONS = ("minimize", "maximize")
KEYS = ("metric", "direction", "trials", "parameters")
STUDY = "tune"


@dataclass(frozen=True)
class Search:
    """A search, as the key `tune` of an experiment file describes it."""
    metric: str
    direction: str
    trials: int
    parameters: dict[str, optuna.distributions.BaseDistribution]
    runs: list[tuple[str, list[Any]]]
    """The keys that vary between the runs of a trial, with their values."""

    @property
    def identity(self) -> str:
        """Returns the settings that must not change when a search is resumed."""
        return json.dumps([self.metric, self.direction, {key: repr(value) for key, value in self.parameters.items()}, self.runs])


def read_search(experiment: Experiment) -> Search:
    """Reads the key `tune`. Raises `ExperimentError` with the line of the first error, including unknown keys."""
    located = experiment.located
    tune = located.root.get("tune")
    if not isinstance(tune, dict):
        raise located.error("'tune' must be an object with 'metric' and 'parameters'", *(["tune"] if "tune" in located.root else []))
    for key in tune:
        if key not in KEYS:
            raise located.error(f"unknown key 'tune.{key}'; known here: {', '.join(KEYS)}", "tune", key)
    if not isinstance(tune.get("metric"), str):
        raise located.error("'tune.metric' must name a metric", "tune")
    direction = tune.get("direction", DIRECTIONS[0])
    if direction not in DIRECTIONS:
        raise located.error(f"'tune.direction' is {json.dumps(direction)}; it must be one of: {', '.join(DIRECTIONS)}", "tune", "direction")
    trials = tune.get("trials", TRIALS)
    if not _is_int(trials) or trials < 1:
        raise located.error(f"'tune.trials' is {json.dumps(trials)}; it must be a whole number above 0", "tune", "trials")
    parameters = tune.get("parameters")
    if not isinstance(parameters, dict) or not parameters:
        raise located.error("'tune.parameters' must be an object with the values of each key", "tune")
    for key in parameters:
        reject_fixed_key(located, "tune", key)
        if key in experiment.fixed or key in experiment.keys:
            raise located.error(f"'{key}' is in 'tune', and also in 'vary', 'zip' or 'set'; remove one", "tune", "parameters", key)
    return Search(tune["metric"], direction, trials, {key: _distribution(located, key, value) for key, value in parameters.items()},
                  experiment.product + experiment.together)


def _distribution(located: Located, key: str, given: Any) -> optuna.distributions.BaseDistribution:
    place = ("tune", "parameters", key)
    if isinstance(given, list):
        if len(given) < 2 or not all(isinstance(value, (str, int, float, bool)) for value in given) or len(set(map(repr, given))) < len(given):
            raise located.error(f"'tune.parameters.{key}' must be at least two different strings, numbers or booleans", *place)
        return optuna.distributions.CategoricalDistribution(given)
    numbers = ("from", "to", "step")
    if not isinstance(given, dict) or not {"from", "to"} <= given.keys() <= {*numbers, "log"} \
            or not all(_is_number(given[name]) for name in numbers if name in given) or not isinstance(given.get("log", False), bool):
        raise located.error(f"'tune.parameters.{key}' must be a list, or an object with the numbers 'from' and 'to', and optionally 'step' or 'log'", *place)
    low, high, step, log = given["from"], given["to"], given.get("step"), given.get("log", False)
    if low >= high or (log and (low <= 0 or step is not None)) or (step is not None and step <= 0):
        raise located.error(f"'tune.parameters.{key}': 'from' must be below 'to', 'step' above 0, and 'log' needs 'from' above 0 and no 'step'", *place)
    if _is_int(low) and _is_int(high) and (step is None or _is_int(step)):
        return optuna.distributions.IntDistribution(low, high, log=log, step=step or 1)
    return optuna.distributions.FloatDistribution(low, high, log=log, step=step)


def tune(experiment: Experiment, search: Search, store: Store, pool: Callable[[], Pool], options: argparse.Namespace) -> int:
    """Executes the remaining trials, up to `jobs` at the same time. Returns the exit code."""
    try:
        return _tune(experiment, search, store, pool, options)
    except (sqlalchemy.exc.SQLAlchemyError, optuna.exceptions.StorageInternalError) as error:
        raise ExperimentError(f"'{os.path.join(store.folder, 'study.db')}' cannot be read or written: {error.__cause__ or error}; if it is damaged, "
                              "delete it and continue with --resume") from error


def _tune(experiment: Experiment, search: Search, store: Store, pool: Callable[[], Pool], options: argparse.Namespace) -> int:
    store.open(experiment, options.resume)
    prepare(experiment.scenario, store.bundle, options.trust_jvm, experiment.runtimes)
    _check(experiment, search, store, options.trust_jvm)
    study = _study(search, store)
    total = options.trials or search.trials
    code = 0
    while code == 0 and (left := total - len(_finished(study))) > 0:
        trials = [study.ask(search.parameters) for _ in range(min(left, options.jobs))]
        runs = {trial.number: [_run(experiment, run, trial.params) for run in experiment.runs()] for trial in trials}
        # Runs are collected by name, because different trials may propose the same values.
        every = {run.name: run for group in runs.values() for run in group}
        todo = [(run, False) for run in every.values() if not store.is_complete(run)]
        if todo:
            code = drive(store, len(todo), todo, pool(), options.jobs, MAX_EQUAL_FAILURES)
        if code >= 128:
            break
        code = 0
        for trial in trials:
            values = [_value(store, run, search.metric) for run in runs[trial.number]]
            if any(math.isnan(value) for value in values):
                study.tell(trial, state=optuna.trial.TrialState.FAIL)
            else:
                study.tell(trial, sum(values) / len(values))
    _write(study, search, os.path.join(store.folder, "trials.csv"))
    done = [trial for trial in _finished(study) if trial.value is not None]
    if not done:
        raise ExperimentError(f"no trial has a value of '{search.metric}'; the messages are in '{store.runs}'")
    print(f"{len(done)} trials, best {search.metric} {text(study.best_value)} in trial {study.best_trial.number}:")
    for key, value in study.best_params.items():
        print(f"  {key} = {text(value)}")
    return code


def _check(experiment: Experiment, search: Search, store: Store, trust: bool) -> None:
    """Validates the metric, and the first and last values of each parameter."""
    categorical = optuna.distributions.CategoricalDistribution
    ends = {key: (list(value.choices) if isinstance(value, categorical) else [value.low, value.high])  # type: ignore[attr-defined]
            for key, value in search.parameters.items()}
    first = {key: values[0] for key, values in ends.items()}
    metrics = check_keys(experiment, store, trust, [({**first, key: value}, ("tune", "parameters", key)) for key, values in ends.items() for value in values])
    converged = Located(experiment.scenario).root.get("converged", {})
    known = [*metrics, *(CONVERGED + name for name in converged)]
    if search.metric not in known:
        raise experiment.located.error(f"'tune.metric' is '{search.metric}', which does not exist; existing metrics: {', '.join(known)}", "tune", "metric")


def _study(search: Search, store: Store) -> optuna.Study:
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    path = os.path.abspath(os.path.join(store.folder, "study.db"))
    if os.path.islink(path):
        raise ExperimentError(f"'{path}' is a symbolic link; remove it, or name another folder with --out")
    # The folder's name may contain characters that are special in a URL.
    storage = sqlalchemy.URL.create("sqlite", database=path).render_as_string()
    study = optuna.create_study(storage=storage, study_name=STUDY, direction=search.direction, load_if_exists=True)
    former = study.user_attrs.setdefault("search", search.identity) if "search" in study.user_attrs else search.identity
    if former != search.identity:
        raise ExperimentError(f"'{store.folder}' belongs to another search: its metric, direction, parameters or varied values differ; name another folder with --out")
    study.set_user_attr("search", search.identity)
    # The seed is the number of trials, so a resumed search always proposes the same values.
    study.sampler = optuna.samplers.TPESampler(seed=len(study.trials), constant_liar=True)
    return study


def _finished(study: optuna.Study) -> list[optuna.trial.FrozenTrial]:
    return study.get_trials(deepcopy=False, states=(optuna.trial.TrialState.COMPLETE, optuna.trial.TrialState.FAIL))


def _run(experiment: Experiment, run: Run, parameters: dict[str, Any]) -> Run:
    values = {**parameters, **run.values}
    settings = experiment.settings(values)
    return Run(name_of(values, settings), values, settings)


def _value(store: Store, run: Run, metric: str) -> float:
    """Returns the value of a metric at the end of a run, or NaN if it has none. The convergence time of a run without convergence is its whole duration."""
    if not store.is_complete(run):
        return math.nan
    with open(os.path.join(store.runs, run.name, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    if metric in manifest["end"]:
        value = float(manifest["end"][metric])
        return value if math.isfinite(value) else math.nan
    time = manifest["converged"].get(metric.removeprefix(CONVERGED))
    return float(manifest["scenario"]["seconds"] if time is None else time)


def _write(study: optuna.Study, search: Search, path: str) -> None:
    """Writes all finished trials to a CSV file."""
    lines: list[str] = []
    writer = csv.writer(argparse.Namespace(write=lines.append), lineterminator="\n")
    writer.writerow(["trial", search.metric, *search.parameters])
    for trial in _finished(study):
        writer.writerow([trial.number, "" if trial.value is None else trial.value, *(trial.params[key] for key in search.parameters)])
    write(path, "".join(lines))


def _is_int(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
