"""Statistics of experiments."""
import numpy as np
import pandas as pd

from collektive_experiments import Results, compare, interval
from collektive_experiments.figures import at_end, over_time


def results(shift: float, size: int = 20) -> Results:
    random = np.random.default_rng(1)
    means = {"a": 0, "b": shift}
    rows = [{"run": f"{program}{seed}", "program": program, "network.loss": 0.1, "seed": seed, "status": "complete", "error": random.normal(means[program])}
            for program in "ab" for seed in range(size)]
    series = [{**row, "second": second, "links": 0} for row in rows for second in (0.0, 1.0)]
    return Results(pd.DataFrame(rows), pd.DataFrame(series), None, ["program", "network.loss", "seed"], {"error": "m"})


def test_an_effect_has_an_interval_that_holds_it() -> None:
    row = compare(results(2), "error", "program").iloc[0]
    assert (row["a"], row["b"], row["n_a"], row["n_b"], row["network.loss"]) == ("a", "b", 20, 20, 0.1)
    assert row["difference_low"] < 2 < row["difference_high"]
    assert 0 < row["delta_low"] <= row["delta"] <= row["delta_high"] <= 1
    assert row["p"] < 0.01


def test_no_effect_has_an_interval_around_zero() -> None:
    row = compare(results(0), "error", "program").iloc[0]
    assert row["difference_low"] < 0 < row["difference_high"]
    assert row["delta_low"] < 0 < row["delta_high"]
    assert row["p"] > 0.05


def test_the_same_values_give_the_same_interval() -> None:
    values = np.arange(10.0)
    low, high = interval(values)
    assert (low, high) == interval(values)
    assert low < 4.5 < high
    # The spread of a mean of ten is 2.87 / sqrt(10).
    assert abs((high - low) - 2 * 1.96 * 2.87 / 10 ** 0.5) < 0.3


def test_one_value_has_no_interval_and_no_effect() -> None:
    assert np.isnan(interval(np.ones(1))).all()
    assert np.isnan(compare(results(2, size=1), "error", "program").iloc[0]["difference"])


def test_runs_that_are_not_complete_do_not_count() -> None:
    some = results(2)
    some.runs.loc[0, "status"] = "crashed"
    assert compare(some, "error", "program").iloc[0]["n_a"] == 19


def test_axes_have_units_and_captions_the_number_of_runs() -> None:
    figure, caption = over_time(results(2), "error")
    axes = figure.axes[0]
    assert axes.get_ylabel() == "error [m]"
    assert axes.get_xlabel() == "simulated time [s]"
    assert axes.get_title() == "loss 0.1"
    assert "95 % bootstrap interval of 20 runs per configuration" in caption
    assert "of 20 runs per configuration" in at_end(results(2), "error")[1]
