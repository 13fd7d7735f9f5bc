"""Reads the key `tune` of an experiment file, which describes a search."""
import json
import math
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from .experiment import Experiment, identity, reject_fixed_key
from .positions import Located
from .store import Store
from .sweep import check_keys, convergence_times

TRIALS = 50
DIRECTIONS = ("minimize", "maximize")
KEYS = ("metric", "direction", "trials", "parameters")
MAX_INT = 2 ** 53
"""The largest whole number in a range. Optuna stores the values of ranges as floats, which would round larger ones."""


@dataclass(frozen=True)
class Search:
    """A search, as the key `tune` of an experiment file describes it."""
    metric: str
    direction: str
    trials: int
    parameters: dict[str, Any]
    """The values of each key: a list, or an object with `from`, `to`, and optionally `step` or `log`."""
    runs: list[Any]
    """The keys of the runs of a trial with their values: those in `vary`, in `zip` and in `set`."""

    @property
    def identity(self) -> str:
        """Returns the settings that must not change when a search is resumed."""
        return json.dumps([self.metric, self.direction, self.parameters, self.runs])


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
    if not is_int(trials) or trials < 1:
        raise located.error(f"'tune.trials' is {json.dumps(trials)}; it must be a whole number above 0", "tune", "trials")
    parameters = tune.get("parameters")
    if not isinstance(parameters, dict) or not parameters:
        raise located.error("'tune.parameters' must be an object with the values of each key", "tune")
    for key in parameters:
        reject_fixed_key(located, "tune", key)
        if key in experiment.fixed or key in experiment.keys:
            raise located.error(f"'{key}' is in 'tune', and also in 'vary', 'zip' or 'set'; remove one", "tune", "parameters", key)
    return Search(tune["metric"], direction, trials, {key: _values(located, key, value) for key, value in parameters.items()},
                  [experiment.product, experiment.together, identity(experiment.fixed)])


def _values(located: Located, key: str, given: Any) -> Any:
    """Checks the values of a key, and returns them."""
    place = ("tune", "parameters", key)
    if isinstance(given, list):
        if len(given) < 2 or not all(isinstance(value, (str, int, float, bool)) for value in given) or len(set(given)) < len(given):
            raise located.error(f"'tune.parameters.{key}' must be at least two different strings, numbers or booleans", *place)
        return given
    numbers = ("from", "to", "step")
    if not isinstance(given, dict) or not {"from", "to"} <= given.keys() <= {*numbers, "log"} \
            or not all(_is_number(given[name]) for name in numbers if name in given) or not isinstance(given.get("log", False), bool):
        raise located.error(f"'tune.parameters.{key}' must be a list, or an object with the numbers 'from' and 'to', and optionally 'step' or 'log'", *place)
    low, high, step, log = given["from"], given["to"], given.get("step"), given.get("log", False)
    if low >= high or (log and (low <= 0 or step is not None)) or (step is not None and step <= 0):
        raise located.error(f"'tune.parameters.{key}': 'from' must be below 'to', 'step' above 0, and 'log' needs 'from' above 0 and no 'step'", *place)
    if is_int(low) and is_int(high) and max(-low, high) > MAX_INT:
        raise located.error(f"'tune.parameters.{key}': whole numbers in a range must be from -2^53 to 2^53; use a list for other values", *place)
    # Optuna computes with the difference, and would reduce a range below one step to its first value. Like Optuna, the test uses decimal numbers.
    exceeds_range = step is not None and Decimal(str(step)) > Decimal(str(high)) - Decimal(str(low))
    if exceeds_range or not math.isfinite(high - low):
        raise located.error(f"'tune.parameters.{key}': 'step' must be at most the difference of 'to' and 'from', which must be finite", *place)
    return given


def check_search(experiment: Experiment, search: Search, store: Store, trust: bool) -> None:
    """Validates the metric, and the first and last values of each parameter."""
    ends = {key: value if isinstance(value, list) else [value["from"], value["to"]] for key, value in search.parameters.items()}
    first = {key: values[0] for key, values in ends.items()}
    metrics = check_keys(experiment, store, trust, [({**first, key: value}, ("tune", "parameters", key)) for key, values in ends.items() for value in values])
    known = [*metrics, *convergence_times(experiment, search.parameters)]
    if search.metric not in known:
        raise experiment.located.error(f"'tune.metric' is '{search.metric}', which does not exist; existing metrics: {', '.join(known)}", "tune", "metric")


def is_int(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
