"""Tests the statistics of experiments."""
import sys
import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from collektive_experiments import Results, compare, draw, holm, interval, kaplan_meier, read_options
from collektive_experiments.figures import _table, _title, at_end, over_time
from collektive_experiments.statistics import paired_effect, unpaired_effect
from collektive_experiments.tables import Table


def results(shift: float, size: int = 20) -> Results:
    random = np.random.default_rng(1)
    means = {"a": 0, "b": shift}
    rows = [{"run": f"{program}{seed}", "program": program, "network.loss": 0.1, "seed": seed, "status": "complete", "error": random.normal(means[program])}
            for program in "ab" for seed in range(size)]
    series = [{**row, "second": second, "links": 0} for row in rows for second in (0.0, 1.0)]
    return Results(pd.DataFrame(rows), pd.DataFrame(series), None, ["program", "network.loss", "seed"], {"error": "m"})


def test_the_interval_of_an_effect_contains_it() -> None:
    row = compare(results(2), "error", "program").iloc[0]
    assert (row["a"], row["b"], row["n_a"], row["n_b"], row["network.loss"]) == ("a", "b", 20, 20, 0.1)
    assert row["difference_low"] < 2 < row["difference_high"]
    assert 0 < row["delta_low"] <= row["delta"] <= row["delta_high"] <= 1
    assert row["p"] < 0.01


def test_the_interval_of_no_effect_contains_zero() -> None:
    row = compare(results(0), "error", "program").iloc[0]
    assert row["difference_low"] < 0 < row["difference_high"]
    assert row["delta_low"] < 0 < row["delta_high"]
    assert row["p"] > 0.05


def test_the_same_values_give_the_same_interval() -> None:
    values = np.arange(10.0)
    low, high = interval(values)
    assert (low, high) == interval(values)
    assert low < 4.5 < high
    # The standard deviation of the mean of ten values is 2.87 / sqrt(10).
    assert abs((high - low) - 2 * 1.96 * 2.87 / 10 ** 0.5) < 0.3


def test_a_single_value_has_no_interval_and_no_effect() -> None:
    assert np.isnan(interval(np.ones(1))).all()
    assert np.isnan(compare(results(2, size=1), "error", "program").iloc[0]["difference"])


def test_a_table_marks_effects_of_one_pair() -> None:
    assert _table(results(2), "error").count("too few runs") == 0
    some = results(2)
    some.runs.loc[20:, "seed"] += 19
    assert compare(some, "error", "program").iloc[0]["pairs"] == 1
    assert _table(some, "error").count("too few runs") == 10


def test_incomplete_runs_are_ignored() -> None:
    some = results(2)
    some.runs.loc[0, "status"] = "crashed"
    assert compare(some, "error", "program").iloc[0]["n_a"] == 19


def test_combined_tables_without_distinct_labels_or_seeds_are_rejected() -> None:
    some = results(2)
    with pytest.raises(ValueError, match="ignore_index"):
        replace(some, runs=pd.concat([some.runs, some.runs]))
    with pytest.raises(ValueError, match="have the same seed"):
        compare(replace(some, runs=pd.concat([some.runs, some.runs], ignore_index=True)), "error", "program")
    twice = replace(some, series=pd.concat([some.series.assign(source=source) for source in "ab"], ignore_index=True),
                    runs=pd.concat([some.runs.assign(source=source, run=source + some.runs["run"]) for source in "ab"], ignore_index=True))
    options = read_options({"metric": "error", "by": "program", "kind": "ecdf"})
    for draw_figure in (lambda: over_time(twice, "error"), lambda: at_end(twice, "error"), lambda: next(draw(twice, options))):
        with pytest.raises(ValueError, match="have the same seed"):
            draw_figure()
    assert over_time(replace(twice, keys=["program", "source", "seed"]), "error")[1].endswith("of 20 runs per configuration.")
    assert list(compare(twice, "error", "source")["pairs"]) == [20, 20]
    # Names of runs do not contain a seed that does not vary.
    again = replace(some, runs=pd.concat([some.runs, some.runs.assign(seed=some.runs["seed"] + 20)], ignore_index=True),
                    series=pd.concat([some.series, some.series.assign(seed=some.series["seed"] + 20)], ignore_index=True))
    assert over_time(again, "error")[1].endswith("of 40 runs per configuration.")


def test_combined_tables_without_a_value_of_a_key_are_rejected() -> None:
    some = results(2)
    with pytest.raises(ValueError, match="runs without a value of the key 'network"):
        replace(some, runs=pd.concat([some.runs, some.runs.drop(columns="network.loss")], ignore_index=True))
    with pytest.raises(ValueError, match="runs without a value of the key 'program'"):
        replace(some, series=pd.concat([some.series, some.series.drop(columns="program")], ignore_index=True))


def test_combined_tables_with_rounded_seeds_are_rejected() -> None:
    some = results(2)
    large = some.runs.assign(seed=np.uint64(1 << 63))
    with pytest.raises(ValueError, match="convert the seeds of all tables to uint64"):
        replace(some, runs=pd.concat([some.runs, large], ignore_index=True))


@pytest.mark.parametrize("key", ["a", "p", "pairs"])
def test_a_key_with_the_name_of_a_column_of_a_comparison_is_rejected(key: str) -> None:
    some = results(2)
    both = replace(some, keys=[*some.keys, key], runs=some.runs.assign(**{key: 1}), series=some.series.assign(**{key: 1}))
    with pytest.raises(ValueError, match=f"the key '{key}' has the name of a column"):
        compare(both, "error", "program")


def test_axes_have_units_and_captions_the_number_of_runs() -> None:
    figure, caption = over_time(results(2), "error")
    axes = figure.axes[0]
    assert axes.get_ylabel() == "error [m]"
    assert axes.get_xlabel() == "simulated time [s]"
    assert axes.get_title() == "loss 0.1"
    assert over_time(replace(results(2), labels={"network.loss": "message loss", "0.1": "low"}), "error")[0].axes[0].get_title() == "message loss low"
    assert "95 % bootstrap interval of 20 runs per configuration" in caption
    assert "of 20 runs per configuration" in at_end(results(2), "error")[1]


def test_titles_distinguish_keys_with_the_same_last_part() -> None:
    some = results(2)
    values, keys = (1.0, 2, 3), ["converged.a.to", "converged.b.to", "network.loss"]
    assert _title(some, values, keys) == "converged.a.to 1, converged.b.to 2, loss 3"
    labelled = replace(some, labels={"network.loss": "message loss [%]", "3": "three", "converged.a.to": "limit"})
    assert _title(labelled, values, keys) == "limit 1, converged.b.to 2, message loss three"


def test_a_caption_counts_the_runs_of_each_time() -> None:
    ended = results(2)
    stopped = (ended.series["run"] == ended.series["run"].iloc[0]) & (ended.series["second"] == ended.series["second"].max())
    caption = over_time(replace(ended, series=ended.series[~stopped]), "error")[1]
    assert "95 % bootstrap interval of 19 to 20 runs per configuration and time" in caption


def test_runs_of_equal_seeds_are_paired() -> None:
    paired = results(0)
    random = np.random.default_rng(4)
    noise = np.tile(random.normal(0, 5, 20), 2)
    paired.runs["error"] = noise + np.repeat([0, 0.3], 20) + random.normal(0, 0.05, 40)
    row = compare(paired, "error", "program").iloc[0]
    assert (row["pairs"], row["delta"]) == (20, 1)
    assert 0.2 < row["difference_low"] < 0.3 < row["difference_high"] < 0.4
    assert row["p"] < 0.01
    # If the runs are not paired, noise hides the difference.
    paired.runs["seed"] = range(40)
    row = compare(paired, "error", "program").iloc[0]
    assert row["pairs"] == 0 and row["p"] > 0.5


def test_pairs_of_values_have_the_same_order_in_all_rows() -> None:
    some = results(2)
    other = some.runs.assign(**{"network.loss": 0.3, "run": "other" + some.runs["run"]})
    # In the experiment, the seed changes more slowly than the program. The first run has failed.
    other.loc[(other["seed"] == 0) & (other["program"] == "a"), "status"] = "failed"
    runs = pd.concat([some.runs, other.sort_values("seed", kind="stable")], ignore_index=True)
    table = compare(replace(some, runs=runs), "error", "program")
    assert list(table["a"]) == ["a", "a"]
    assert (table["difference"] > 1).all()


def test_comparing_many_unpaired_runs_needs_little_memory() -> None:
    tracemalloc.start()
    try:
        unpaired_effect(np.arange(200.0), np.arange(200.0) + 10)
        assert tracemalloc.get_traced_memory()[1] < 100e6
    finally:
        tracemalloc.stop()


def test_few_pairs_have_an_exact_p_value() -> None:
    few = results(0, size=5)
    few.runs["error"] = [1, 2, 3, 4, 5, 2, 4, 6, 8, 10]
    assert compare(few, "error", "program").iloc[0]["p"] == 2 / 2 ** 5


def test_holm_corrects_as_published_and_never_lowers_or_reorders() -> None:
    assert holm(np.array([0.01, 0.04, 0.03, 0.005])) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    random = np.random.default_rng(5)
    for size in range(1, 30):
        values = random.random(size) ** 3
        values[random.random(size) < 0.2] = np.nan
        corrected = holm(values)
        assert (np.isnan(corrected) == np.isnan(values)).all()
        known = ~np.isnan(values)
        assert (corrected[known] >= values[known]).all() and (corrected[known] <= 1).all()
        assert (np.diff(corrected[known][np.argsort(values[known])]) >= 0).all()
        assert (corrected[known] <= values[known] * known.sum() + 1e-12).all(), "Holm's correction must not exceed Bonferroni's"


def test_the_index_of_a_series_and_the_type_of_numbers_do_not_change_statistics() -> None:
    values, is_observed = np.array([3.0, 1, 2, 5, 4]), np.array([True, False, True, True, False])
    for index in (range(5), [4, 2, 0, 3, 1], list("abcde")):
        sample = pd.Series(values, index=index)
        assert list(holm(sample / 100)) == list(holm(values / 100))
        assert interval(sample) == interval(values)
        for observed in (pd.Series(is_observed, index=index), is_observed.astype(int), list(is_observed)):
            for curve, expected in zip(kaplan_meier(sample, observed), kaplan_meier(values, is_observed)):
                np.testing.assert_array_equal(curve, expected)


def test_kaplan_meier_reproduces_a_published_curve() -> None:
    # Weeks in remission with 6-mercaptopurine, from Freireich et al. (1963).
    times = np.array([6, 6, 6, 7, 10, 13, 16, 22, 23, 6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35], float)
    moments, shares, low, high = kaplan_meier(times, np.arange(21) < 9)
    assert list(moments) == [6, 7, 10, 13, 16, 22, 23]
    assert 1 - shares == pytest.approx([0.857, 0.807, 0.753, 0.690, 0.627, 0.538, 0.448], abs=5e-4)
    # These values come from R: survfit(..., conf.type = "log-log").
    assert (1 - high[0], 1 - low[0]) == pytest.approx((0.620, 0.952), abs=1e-3)


def test_kaplan_meier_of_uncensored_runs_is_the_empirical_distribution() -> None:
    random = np.random.default_rng(6)
    for size in range(1, 30):
        times = random.integers(1, 10, size).astype(float)
        moments, shares, low, high = kaplan_meier(times, np.ones(size, bool))
        assert shares == pytest.approx([(times <= moment).mean() for moment in moments])
        assert ((low <= shares) & (shares <= high))[:-1].all()
        # Censored runs lower the estimate. If all runs are censored, nothing can be estimated.
        moments, shares, _, _ = kaplan_meier(times, random.random(size) < 0.5)
        assert all(share <= (times <= moment).mean() + 1e-12 for moment, share in zip(moments, shares))
    assert len(kaplan_meier(np.ones(3), np.zeros(3, bool))[0]) == 0


@pytest.mark.parametrize("scale", [1e-15, 1e4, 1e9])
def test_p_values_do_not_depend_on_the_unit(scale: float) -> None:
    a = np.random.default_rng(0).random(4)
    b = a[::-1] * 0.9 + 1.5
    assert unpaired_effect(a, b)["p"] == pytest.approx(2 / 70, abs=0.01)
    for effect in (unpaired_effect, paired_effect):
        assert effect(scale * a, scale * b)["p"] == effect(a, b)["p"]


def test_a_varied_key_of_convergence_is_not_a_convergence_time() -> None:
    some = results(0)
    some.runs["converged.error.seconds"] = 1.0
    assert replace(some, keys=[*some.keys, "converged.error.seconds"]).convergence_times == []


def test_values_are_compared_although_other_keys_of_a_zip_vary_with_them() -> None:
    some = results(2)
    some.runs["gain"] = some.runs["program"].map({"a": 1, "b": 2})
    keys = [*some.keys, "gain"]
    table = compare(replace(some, keys=keys, zipped=["program", "gain"]), "error", "program")
    assert len(table) == 1
    assert "gain" not in table
    # In a table with a part of the runs, the difference could be due to either key.
    assert compare(replace(some, keys=keys), "error", "program").empty


def test_a_metric_with_the_name_of_another_column_is_compared_instead_of_this_column() -> None:
    some = results(2)
    named = replace(some, runs=some.runs.rename(columns={"error": "metric.nodes"}).assign(nodes=49),
                    series=pd.DataFrame(columns=["second", "metric.nodes", "links"]))
    pd.testing.assert_frame_equal(compare(named, "nodes", "program"), compare(some, "error", "program"))


def test_rounding_errors_are_not_effects() -> None:
    a, b = np.array([0.3, 0.6, 1e300]), np.array([0.1 + 0.2, 0.2 + 0.4, 1e300])
    assert (b > a).sum() == 2
    assert paired_effect(a, b)["delta"] == unpaired_effect(a, b)["delta"] == 0


def test_an_interruption_while_a_table_is_written_prints_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ignored: list[sys.UnraisableHookArgs] = []
    monkeypatch.setattr(sys, "unraisablehook", ignored.append)

    def interrupt(table: Table) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Table, "_flush", interrupt)
    with pytest.raises(KeyboardInterrupt), Table(str(tmp_path / "runs"), pa.schema([("run", pa.string())]), True):
        pass
    assert not ignored
