"""Computes statistics of samples: intervals, effect sizes, corrected p-values and Kaplan-Meier curves."""
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

RESAMPLES = 2000
"""The number of bootstrap samples. With this number, the ends of an interval are accurate to about 1/40 of its length."""
MAX_EXACT_PAIRS = 12
"""The maximum number of pairs for which the permutation test enumerates all sign changes."""
NORMAL_95 = 1.959963984540054
"""The 97.5 % quantile of the normal distribution."""
ROUNDING = 1e-14
"""The share of the largest value below which differences count as equal. It is 45 times the precision of a float, which exceeds the rounding errors of
NumPy's sums, because these grow only with the logarithm of the number of values."""
EFFECTS = ("mean_a", "mean_b", "difference", "difference_low", "difference_high", "delta", "delta_low", "delta_high", "p")


def interval(values: Floats, statistic: Any = np.mean, confidence: float = 0.95) -> tuple[float, float]:
    """
    Returns the percentile bootstrap interval of a statistic of a sample.

    The statistic is a function with the parameter `axis`, such as `numpy.mean`. The resampling has a fixed seed, so equal values give equal intervals.
    The interval of fewer than two values is NaN.
    """
    values = np.asarray(values, float)
    if len(values) < 2:
        return float("nan"), float("nan")
    random = np.random.default_rng(0)
    estimates = statistic(values[random.integers(0, len(values), (RESAMPLES, len(values)))], axis=1)
    low, high = np.quantile(estimates, [(1 - confidence) / 2, (1 + confidence) / 2])
    return float(low), float(high)


def unpaired_effect(a: Floats, b: Floats) -> dict[str, float]:
    """Compares two independent samples. The p-value comes from a permutation test of the difference of means."""
    if len(a) < 2 or len(b) < 2:
        return dict.fromkeys(EFFECTS, float("nan"))
    random = np.random.default_rng(0)
    chosen_a, chosen_b = (random.integers(0, len(values), (RESAMPLES, len(values))) for values in (a, b))
    differences = np.quantile(b[chosen_b].mean(axis=1) - a[chosen_a].mean(axis=1), [0.025, 0.975])
    signs = _signs(a[:, None], b[None, :])
    # Multiplying by the number of times that each value was chosen needs less memory than the signs of all chosen pairs.
    counts_a, counts_b = (np.array([np.bincount(row, minlength=chosen.shape[1]) for row in chosen]) for chosen in (chosen_a, chosen_b))
    deltas = np.quantile(((counts_a @ signs) * counts_b).sum(axis=1) / signs.size, [0.025, 0.975])
    difference = b.mean() - a.mean()
    both = np.concatenate([a, b])
    shuffled = random.permuted(np.tile(both, (RESAMPLES, 1)), axis=1)
    extreme = np.abs(shuffled[:, len(a):].mean(axis=1) - shuffled[:, :len(a)].mean(axis=1)) >= abs(difference) - _slack(a, b)
    values = (a.mean(), b.mean(), difference, *differences, signs.mean(), *deltas, (extreme.sum() + 1) / (RESAMPLES + 1))
    return dict(zip(EFFECTS, map(float, values)))


def paired_effect(a: Floats, b: Floats) -> dict[str, float]:
    """Compares two samples whose values at equal indices are pairs. The p-value comes from a sign permutation test of the mean difference."""
    if len(a) < 2:
        return dict.fromkeys(EFFECTS, float("nan"))
    differences, order = b - a, _signs(a, b)
    count = len(differences)
    random = np.random.default_rng(0)
    chosen = random.integers(0, count, (RESAMPLES, count))
    bounds, deltas = (np.quantile(values[chosen].mean(axis=1), [0.025, 0.975]) for values in (differences, order))
    is_exact = count <= MAX_EXACT_PAIRS
    signs = ((np.arange(2 ** count)[:, None] >> np.arange(count)) & 1) * 2 - 1 if is_exact else random.choice((-1, 1), (RESAMPLES, count))
    extreme = np.abs((signs * differences).mean(axis=1)) >= abs(differences.mean()) - _slack(a, b)
    p = extreme.mean() if is_exact else (extreme.sum() + 1) / (RESAMPLES + 1)
    values = (a.mean(), b.mean(), differences.mean(), *bounds, order.mean(), *deltas, p)
    return dict(zip(EFFECTS, map(float, values)))


def _signs(a: Floats, b: Floats) -> Floats:
    """Returns 1 where `b` is greater than `a`, -1 where it is smaller, and 0 where the values differ only by rounding errors."""
    differences = b - a
    return np.sign(differences) * (np.abs(differences) > ROUNDING * np.maximum(np.abs(a), np.abs(b)))


def _slack(a: Floats, b: Floats) -> float:
    """Returns the difference below which two differences of means count as equal."""
    return ROUNDING * float(max(np.abs(a).max(), np.abs(b).max()))


def holm(values: Floats) -> Floats:
    """Corrects p-values for multiple comparisons with Holm's method. A NaN stays NaN and does not count as a comparison."""
    # The index of a pandas Series selects values by labels, not by positions.
    values = np.asarray(values, float)
    corrected = np.full(len(values), np.nan)
    order = np.argsort(values, kind="stable")[:np.count_nonzero(~np.isnan(values))]
    corrected[order] = np.minimum(1, np.maximum.accumulate(values[order] * np.arange(len(order), 0, -1)))
    return corrected


def kaplan_meier(times: Floats, is_observed: npt.NDArray[np.bool_]) -> tuple[Floats, Floats, Floats, Floats]:
    """
    Estimates the share of runs in which an event has occurred by each point in time.

    The time of a run without the event, which is censored, is the end of its observation. Returns the times of events, the share after each of them, and
    the limits of its 95 % interval, which uses Greenwood's variance of log(-log). The limits are NaN where the share is 1. If no run is censored, the
    share is the empirical distribution function.
    """
    times, is_observed = np.asarray(times, float), np.asarray(is_observed, bool)
    moments = np.unique(times[is_observed])
    at_risk = (times[None, :] >= moments[:, None]).sum(axis=1)
    events = ((times[None, :] == moments[:, None]) & is_observed).sum(axis=1)
    survival = np.cumprod(1 - events / at_risk)
    with np.errstate(divide="ignore", invalid="ignore"):
        spread = NORMAL_95 * np.sqrt(np.cumsum(events / (at_risk * (at_risk - events)))) / np.log(survival)
        low, high = 1 - survival ** np.exp(spread), 1 - survival ** np.exp(-spread)
    is_bounded = survival > 0
    return moments, 1 - survival, np.where(is_bounded, np.minimum(low, high), np.nan), np.where(is_bounded, np.maximum(low, high), np.nan)
