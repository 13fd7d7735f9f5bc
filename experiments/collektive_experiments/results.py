"""Loads and compares the tables of a sweep, for notebooks and figures."""
import itertools
import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd

from .experiment import text
from .positions import ExperimentError
from .store import Store

RESAMPLES = 2000
"""Number of bootstrap samples. The ends of an interval are then accurate to about 1/40 of its length."""


@dataclass(frozen=True)
class Results:
    """The tables of a sweep."""
    runs: pd.DataFrame
    """A row for each run: parameters, `seed`, `status`, `digest`, metrics at the end, times, versions."""
    series: pd.DataFrame
    """A row for each complete run and interval of metrics (by default a simulated second)."""
    nodes: pd.DataFrame | None
    """A row for each complete run, time and node; None if the scenario does not ask for `outputs.nodes`."""
    keys: list[str]
    """The keys that vary."""
    units: dict[str, str]
    """Units of the metrics that the experiment file measures, by column; empty if it names none."""

    @property
    def configuration(self) -> list[str]:
        """The keys that vary, except the seed. Runs with equal values of these keys are repetitions."""
        return [key for key in self.keys if key != "seed"]

    @property
    def metrics(self) -> list[str]:
        """The columns of the scene's metrics."""
        columns = list(self.series.columns)
        return columns[columns.index("second") + 1:columns.index("links")]

    @property
    def complete(self) -> pd.DataFrame:
        """The runs that are complete."""
        return self.runs[self.runs["status"] == "complete"]


def load(folder: str) -> Results:
    """Reads the tables of a sweep's folder."""
    settings = Store(folder).settings()
    nodes = _read(folder, "nodes") if os.path.exists(os.path.join(folder, "nodes.parquet")) else None
    results = Results(_read(folder, "runs"), _read(folder, "series"), nodes, settings["keys"], {})
    return replace(results, units=dict(zip(results.metrics, settings["measure"].values())))


def _read(folder: str, name: str) -> pd.DataFrame:
    try:
        return pd.read_parquet(os.path.join(folder, f"{name}.parquet"))
    except (OSError, ValueError) as error:
        raise ExperimentError(f"'{folder}' has no usable {name}.parquet ({error}): make the tables with ./collektive sweep EXPERIMENT.json --out {folder} "
                              "--resume") from error


def interval(values: np.ndarray, statistic: Any = np.mean, confidence: float = 0.95) -> tuple[float, float]:
    """
    Returns the percentile bootstrap interval of a statistic of one sample, or of an axis of samples. The seed of the resampling is fixed, so the
    same values give the same interval. Returns NaN for fewer than two values.
    """
    if len(values) < 2:
        return float("nan"), float("nan")
    random = np.random.default_rng(0)
    estimates = statistic(values[random.integers(0, len(values), (RESAMPLES, len(values)))], axis=1)
    low, high = np.quantile(estimates, [(1 - confidence) / 2, (1 + confidence) / 2])
    return float(low), float(high)


def compare(results: Results, metric: str, by: str) -> pd.DataFrame:
    """
    Compares the end values of a metric, or any other number of the runs' table, between each two values of a key, for each combination of
    the other keys. A row has both means, `difference` of the means with the 95 % bootstrap interval `difference_low` to `difference_high`, and
    Cliff's `delta` with its interval: the probability that a run of `b` has the greater value, minus the probability that it has the smaller
    one; from -1 to 1, 0 for no effect. `p` is the p-value of a permutation test of the difference. `n_a` and `n_b` count runs with a value.
    """
    rows = []
    others = [key for key in results.configuration if key != by]
    groups = results.complete.groupby(others, sort=False, dropna=False) if others else [((), results.complete)]
    for place, group in groups:
        samples = {value: part[metric].dropna().to_numpy(float) for value, part in group.groupby(by, sort=False)}
        for first, second in itertools.combinations(samples, 2):
            a, b = samples[first], samples[second]
            rows.append({**dict(zip(others, place)), "a": first, "b": second, "n_a": len(a), "n_b": len(b), **_effect(a, b)})
    return pd.DataFrame(rows)


def _effect(a: np.ndarray, b: np.ndarray) -> dict[str, float]:
    names = ("mean_a", "mean_b", "difference", "difference_low", "difference_high", "delta", "delta_low", "delta_high", "p")
    if len(a) < 2 or len(b) < 2:
        return dict.fromkeys(names, float("nan"))
    random = np.random.default_rng(0)
    samples_a = a[random.integers(0, len(a), (RESAMPLES, len(a)))]
    samples_b = b[random.integers(0, len(b), (RESAMPLES, len(b)))]
    differences = np.quantile(samples_b.mean(axis=1) - samples_a.mean(axis=1), [0.025, 0.975])
    deltas = np.quantile(np.sign(samples_b[:, None, :] - samples_a[:, :, None]).mean(axis=(1, 2)), [0.025, 0.975])
    difference = b.mean() - a.mean()
    both = np.concatenate([a, b])
    shuffled = random.permuted(np.tile(both, (RESAMPLES, 1)), axis=1)
    extreme = np.abs(shuffled[:, len(a):].mean(axis=1) - shuffled[:, :len(a)].mean(axis=1)) >= abs(difference) - 1e-12
    values = (a.mean(), b.mean(), difference, *differences, np.sign(b[None, :] - a[:, None]).mean(), *deltas, (extreme.sum() + 1) / (RESAMPLES + 1))
    return dict(zip(names, map(float, values)))


def label(values: tuple[Any, ...], keys: list[str]) -> str:
    """Formats a configuration for titles: the last part of each key, and its value."""
    return ", ".join(f"{key.split('.')[-1]} {text(value.item() if hasattr(value, 'item') else value)}" for key, value in zip(keys, values))
