"""Reads experiment files, which name a scenario, the keys that vary, and the metrics."""
import hashlib
import itertools
import json
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from .figure_options import FigureOptions, check_keys, read_options
from .positions import ExperimentError, Located

KEYS = ("version", "scenario", "vary", "zip", "set", "measure", "figures", "labels", "tune")
VERSION = 1
MAX_RUNS = 100_000
MAX_PREFIX = 120
"""The maximum length of the readable part of a folder's name. File systems allow 255 bytes for the whole name."""
FIXED = ("version", "scene", "scripts", "schema", "programs", "data", "runtimeJars", "runtimePlugin")
"""Keys that cannot vary, because their files are compiled or copied once for all runs."""
NOT_FOR_RUNS = ("outputs.metrics", "outputs.replay", "outputs.pictures")
RUNTIME = "runtime"
"""The key of the aggregate runtime. It can vary, because the bundle contains the programs compiled for each runtime."""
RUNTIMES = ("builtin", "collektive")
IGNORING_CASE = (RUNTIME, "schedule", "fields.deployment.kind", "fields.neighbourhood.kind", "fields.movement.kind")
"""Keys whose values the player reads without regard to case."""
RANGE = re.compile(r"(-?[0-9]{1,20})-(-?[0-9]{1,20})(?::([0-9]{1,20}))?")

Values = dict[str, Any]


@dataclass(frozen=True)
class Run:
    """One run of an experiment."""
    name: str
    """The name of the run's folder, which consists of the values of the keys that vary and a hash of all settings."""
    values: Values = field(hash=False)
    """The values of the keys that vary."""
    settings: Values = field(hash=False)
    """All keys that the run sets."""

    @property
    def process(self) -> str:
        """
        The settings with which a process starts, as JSON.

        Runs can share a process only if these settings are equal, because a process starts only one JVM, and programs are compiled for one runtime.
        """
        keys = [key for key in self.settings if key in ("jvm", RUNTIME) or key.startswith("jvm.")]
        return json.dumps({key: self.settings[key] for key in keys}, sort_keys=True)


@dataclass(frozen=True)
class Experiment:
    """A validated experiment file."""
    path: str
    scenario: Located
    """The scenario file."""
    product: list[tuple[str, list[Any]]]
    """The keys of `vary`, whose values are combined with all values of the other keys."""
    together: list[tuple[str, list[Any]]]
    """The keys of `zip`, which vary together."""
    fixed: Values
    """The keys of `set`, which have the same value in all runs."""
    seed: Any
    """The seed of runs in which it does not vary."""
    measure: dict[str, str]
    """The units of the metrics in tables and figures, in their order. If empty, all metrics of the scene are measured."""
    figures: list[FigureOptions] = field(hash=False)
    """Figures that are drawn in addition to the two figures of each metric."""
    labels: dict[str, str] = field(hash=False)
    """The texts that figures show instead of metrics, keys or values."""
    located: Located = field(repr=False)

    @property
    def keys(self) -> list[str]:
        """The keys that vary."""
        return [key for key, _ in self.product + self.together]

    @property
    def runtimes(self) -> list[str]:
        """The runtimes of the runs in lower case. The list is empty if all runs use the runtime of the scenario."""
        values = dict(self.product + self.together).get(RUNTIME) or ([self.fixed[RUNTIME]] if RUNTIME in self.fixed else [])
        return sorted({value.lower() for value in values})

    @property
    def count(self) -> int:
        """The number of runs."""
        count = len(self.together[0][1]) if self.together else 1
        for _, values in self.product:
            count *= len(values)
        return count

    def runs(self) -> Iterator[Run]:
        """Yields all runs in the order of the file. The value of the last key changes fastest."""
        rows = [dict(zip([key for key, _ in self.together], row)) for row in zip(*(values for _, values in self.together))] or [{}]
        for chosen in itertools.product(*(values for _, values in self.product)):
            for row in rows:
                values = {**dict(zip([key for key, _ in self.product], chosen)), **row}
                settings = self.settings(values)
                yield Run(name_of(values, settings), values, settings)

    def settings(self, values: Values) -> Values:
        """Returns all keys of a run. The key of an object comes before keys inside that object, because it would overwrite them."""
        return dict(sorted({**self.fixed, **values}.items(), key=lambda item: item[0].count(".")))


def name_of(values: Values, settings: Values) -> str:
    """Returns a readable and unique name for a run's folder."""
    prefix = ",".join(f"{key}={text(value)}" for key, value in values.items()) or "run"
    return re.sub(r"[^A-Za-z0-9._+,=-]", "_", prefix)[:MAX_PREFIX] + "-" + hashlib.sha256(identity(settings).encode()).hexdigest()[:12]


def identity(value: Any) -> str:
    """Returns a canonical string, which is the same for values that make no difference to a run, such as 1 and 1.0."""
    def normalize(part: Any) -> Any:
        if isinstance(part, dict):
            return {key: normalize(item) for key, item in part.items()}
        if isinstance(part, (list, tuple)):
            return [normalize(item) for item in part]
        return int(part) if isinstance(part, float) and part.is_integer() and str(part) != "-0.0" else part
    return json.dumps(normalize(value), sort_keys=True)


def text(value: Any) -> str:
    """Formats a value for names and legends."""
    if isinstance(value, list):
        return "_".join(map(text, value))
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return value if isinstance(value, str) else json.dumps(value)


def read(path: str) -> Experiment:
    """Reads an experiment file. Raises `ExperimentError` with the line of the first error, including unknown keys."""
    located = Located(path)
    root = located.root
    if not isinstance(root, dict):
        raise located.error("the file must contain one JSON object")
    for key in root:
        if key not in KEYS:
            raise located.error(f"unknown key '{key}'; known here: {', '.join(KEYS)}", key)
    for key, kind, name in (("version", int, "a whole number"), ("scenario", str, "a string"), ("vary", dict, "an object"), ("zip", dict, "an object"),
                            ("set", dict, "an object")):
        if key in root and (not isinstance(root[key], kind) or isinstance(root[key], bool)):
            raise located.error(f"'{key}' is {json.dumps(root[key])}; it must be {name}", key)
    for key in ("version", "scenario"):
        if key not in root:
            raise located.error(f"the key '{key}' is missing")
    if root["version"] != VERSION:
        raise located.error(f"version {root['version']} is not supported; use version {VERSION}", "version")
    # Like paths in scenarios, `..` removes the name before it, even if that is a symbolic link.
    scenario = os.path.normpath(os.path.join(os.path.dirname(path), root["scenario"]))
    if not os.path.isfile(scenario):
        raise located.error(f"the scenario file '{scenario}' does not exist", "scenario")
    settings = Located(scenario)
    if not isinstance(settings.root, dict):
        raise ExperimentError(f"{scenario}: the file must contain one JSON object")
    if "scenario" in settings.root:
        # The player would repeat the run of a manifest and ignore the values of keys.
        raise located.error(f"'{scenario}' is the manifest of a run or an experiment; name a scenario file", "scenario")
    fixed = _read_set(located)
    experiment = Experiment(path, settings, _read_vary(located, "vary"), _read_vary(located, "zip"), fixed, fixed.get("seed", settings.root.get("seed", 1)),
                            _read_measure(located), read_figures(located), _read_labels(located), located)
    _check(experiment)
    return experiment


def _read_vary(located: Located, part: str) -> list[tuple[str, list[Any]]]:
    varied = []
    for key, values in located.root.get(part, {}).items():
        reject_fixed_key(located, part, key)
        if isinstance(values, str):
            values = _range(located, part, key, values)
        if not isinstance(values, list):
            raise located.error(f"'{part}.{key}' is {json.dumps(values)}; it must be a list or a range, like \"1-20\"", part, key)
        if not values:
            raise located.error(f"'{part}.{key}' is an empty list; add at least one value", part, key)
        for index, value in enumerate(values):
            numbers = isinstance(value, list) and value and all(isinstance(number, (int, float)) and not isinstance(number, bool) for number in value)
            if not numbers and not isinstance(value, (str, int, float, bool)):
                raise located.error(f"'{part}.{key}[{index}]' is {json.dumps(value)}; it must be a number, a string, true, false or a list of numbers",
                                    part, key, index)
        varied.append((key, values))
    return varied


def _range(located: Located, part: str, key: str, range_text: str) -> list[int]:
    match = RANGE.fullmatch(range_text)
    if not match:
        raise located.error(f"'{part}.{key}' is {json.dumps(range_text)}, which is not a range; write \"1-20\", or \"0-100:10\" for steps", part, key)
    first, last, step = int(match[1]), int(match[2]), int(match[3] or 1)
    if first > last or step == 0:
        raise located.error(f"'{part}.{key}' is {json.dumps(range_text)}, which contains no values", part, key)
    if (last - first) // step >= MAX_RUNS:
        raise located.error(f"'{part}.{key}' has {(last - first) // step + 1:,} values; the maximum is {MAX_RUNS:,} runs", part, key)
    return list(range(first, last + 1, step))


def _read_set(located: Located) -> Values:
    for key in located.root.get("set", {}):
        reject_fixed_key(located, "set", key)
    return dict(located.root.get("set", {}))


def reject_fixed_key(located: Located, part: str, key: str) -> None:
    if key.split(".")[0] in FIXED or (part == "tune" and key == RUNTIME):
        raise located.error(f"'{key}' cannot vary, because the sweep compiles and copies once: set it in the scenario", part, key)
    if key in NOT_FOR_RUNS or key == "outputs":
        raise located.error(f"'{key}' cannot be set in sweeps, whose runs write metrics only", part, key)


def _read_measure(located: Located) -> dict[str, str]:
    measure = located.root.get("measure", {})
    if isinstance(measure, list) and measure and all(isinstance(name, str) for name in measure):
        return dict.fromkeys(measure, "")
    if isinstance(measure, dict) and all(isinstance(unit, str) for unit in measure.values()):
        return dict(measure)
    raise located.error("'measure' must be a list of metrics, or an object with the unit of each metric", "measure")


def read_figures(located: Located) -> list[FigureOptions]:
    """Reads the key `figures` of an experiment file or of a sweep's settings."""
    figures = located.root.get("figures", [])
    if not isinstance(figures, list):
        raise located.error("'figures' must be a list of objects", "figures")
    return [_read_figure(located, index, figure) for index, figure in enumerate(figures)]


def _read_figure(located: Located, index: int, figure: Any) -> FigureOptions:
    if not isinstance(figure, dict):
        raise located.error(f"'figures[{index}]' is {json.dumps(figure)}; it must be an object", "figures", index)
    return read_options(figure, lambda option, problem: located.error(f"'figures[{index}].{option}' {problem}", "figures", index, option))


def _read_labels(located: Located) -> dict[str, str]:
    labels = located.root.get("labels", {})
    if not isinstance(labels, dict):
        raise located.error("'labels' must be an object with the text of each metric, key or value", "labels")
    for name, label in labels.items():
        if not isinstance(label, str) or not label.strip() or not label.isprintable():
            raise located.error(f"'labels.{name}' is {json.dumps(label)}; it must be a non-empty string of one line", "labels", name)
    return dict(labels)


def check_labels(experiment: Experiment, metrics: list[str]) -> None:
    """Checks that each label belongs to a metric, key or value."""
    known = {*metrics, *experiment.keys, *(text(value) for _, values in experiment.product + experiment.together for value in values)}
    for name in experiment.labels:
        if name not in known:
            raise experiment.located.error(f"'labels.{name}' is unknown: it is not one of the varied keys ({', '.join(experiment.keys)}), their values, or the "
                                           f"metrics ({', '.join(metrics)})", "labels", name)


def _check(experiment: Experiment) -> None:
    located = experiment.located
    seen: dict[str, str] = {}
    for part in ("vary", "zip", "set"):
        for key in located.root.get(part, {}):
            if key in seen:
                raise located.error(f"'{key}' is also in '{seen[key]}'; remove one", part, key)
            seen[key] = part
        values = located.root.get(part, {}).get(RUNTIME, [])
        for value in values if isinstance(values, list) else [values]:
            if not isinstance(value, str) or value.lower() not in RUNTIMES:
                raise located.error(f"'{part}.{RUNTIME}' is {json.dumps(value)}; it must be BuiltIn or Collektive", part, RUNTIME)
    for key, values in experiment.together:
        first = experiment.together[0]
        if len(values) != len(first[1]):
            raise located.error(f"'zip.{key}' has {len(values)} values and 'zip.{first[0]}' has {len(first[1])}: these must be equal", "zip", key)
    if experiment.count > MAX_RUNS:
        raise located.error(f"the experiment has {experiment.count:,} runs; the maximum is {MAX_RUNS:,}", "vary")
    for key, values in experiment.product:
        _reject_duplicates(located, "vary", [key], [(value,) for value in values])
    for options in experiment.figures:
        check_keys(options, dict(experiment.product + experiment.together))
    if experiment.together:
        _reject_duplicates(located, "zip", [key for key, _ in experiment.together], list(zip(*(values for _, values in experiment.together))))


def _reject_duplicates(located: Located, part: str, keys: list[str], rows: list[tuple[Any, ...]]) -> None:
    seen: set[str] = set()
    for index, row in enumerate(rows):
        row = tuple(value.lower() if key in IGNORING_CASE and isinstance(value, str) else value for key, value in zip(keys, row))
        # Values such as 1 and "1" count as duplicates, too, because tables and figures show the same text for both.
        forms = {identity(row), "\0".join(map(text, row))}
        if forms & seen:
            twice = ", ".join(f"{key}={text(value)}" for key, value in zip(keys, row))
            raise located.error(f"duplicate runs: '{twice}' occurs twice", part, keys[0], index)
        seen |= forms


__all__ = ["Experiment", "ExperimentError", "Run", "read"]
