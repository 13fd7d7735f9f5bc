"""Loads and compares the tables of a sweep, for notebooks and figures."""
import itertools
import os
import re
from dataclasses import dataclass, field, replace

import pandas as pd
import pyarrow as pa

from .figure_options import CENSORED, CONVERGED
from .positions import ExperimentError
from .statistics import EFFECTS, holm, paired_effect, unpaired_effect
from .store import Store
from .tables import CONTENT, read_parquet

VALUE = "value\0"
"""The name of a column with the values to compare. No metric can have this name."""


@dataclass(frozen=True)
class Results:
    """The tables of a sweep."""
    runs: pd.DataFrame
    """A row for each run: parameters, `seed`, `status`, `digest`, the metrics at the end, times and versions."""
    series: pd.DataFrame
    """A row for each complete run and each interval of its metrics, which is a simulated second by default."""
    nodes: pd.DataFrame | None
    """A row for each complete run, time and node, or None if the scenario does not request `outputs.nodes`."""
    keys: list[str]
    """The keys that vary."""
    units: dict[str, str]
    """The units of the metrics in the experiment file, by column. Empty if the file does not list metrics."""
    labels: dict[str, str] = field(default_factory=dict)
    """The texts that figures show instead of metrics, keys or values."""
    zipped: list[str] = field(default_factory=list)
    """The keys of the experiment's `zip`. Sweeps of earlier versions did not store them: for these, all keys that vary."""

    def __post_init__(self) -> None:
        """
        Checks combined tables. Labels that occur twice would mix values of different runs. Figures would omit runs without a value of a key. Rounded
        seeds would pair different runs.
        """
        if not self.runs.index.is_unique:
            raise ValueError("the index of the runs contains a label twice: combine tables with ignore_index=True")
        if any(pd.api.types.is_float_dtype(table["seed"]) for table in (self.runs, self.series) if "seed" in table):
            raise ValueError("a table contains rounded seeds: convert the seeds of all tables to uint64 before you combine them")
        for table, key in itertools.product((self.runs, self.series), self.keys):
            if key in table and table[key].isna().any():
                raise ValueError(f"a table contains runs without a value of the key '{key}': add this value before you combine tables")

    @property
    def configuration(self) -> list[str]:
        """The keys that vary, except the seed. Runs are repetitions of each other if they have equal values of these keys."""
        return [key for key in self.keys if key != "seed"]

    def other_keys(self, shown: list[str]) -> list[str]:
        """Returns the other keys of the configuration, except those that a shown key of the same `zip` determines."""
        shown_zipped = [key for key in shown if key in self.zipped]
        return [key for key in self.configuration if key not in shown and not (
            shown_zipped and key in self.zipped and self.runs[key].nunique() > 1 and self.runs.groupby(shown_zipped)[key].nunique().max() == 1)]

    @property
    def metrics(self) -> list[str]:
        """The columns of the scene's metrics."""
        columns = list(self.series.columns)
        return columns[columns.index("second") + 1:columns.index("links")]

    def column(self, metric: str) -> str:
        """Returns the column of a metric, which has the prefix `metric.` if another column has the metric's name."""
        return metric if metric in self.metrics else next((name for name in self.metrics if name_of_metric(name) == metric), metric)

    @property
    def complete(self) -> pd.DataFrame:
        """The runs that are complete."""
        return self.runs[self.runs["status"] == "complete"]

    @property
    def selected_series(self) -> pd.DataFrame:
        """The rows of `series` for the runs in the table of runs, which may be filtered."""
        columns = [key for key in dict.fromkeys([*self.keys, "seed"]) if key in self.series]
        selected, rows = (pd.MultiIndex.from_frame(table[columns]) for table in (self.runs, self.series))
        return self.series[rows.isin(selected)]

    @property
    def convergence_times(self) -> list[str]:
        """The columns of convergence times."""
        return [name for name in self.runs.columns if name.startswith(CONVERGED) and name not in self.keys]

    def censored(self, metric: str) -> "pd.Series[bool]":
        """Returns for each complete run whether only a lower bound of its convergence time is known. Values of other metrics are never censored."""
        values = self.complete[metric]
        return values.isna() & self.values(metric).notna()

    def values(self, metric: str) -> "pd.Series[float]":
        """Returns the value of each complete run at its end. For a censored run, this is the last convergence time that could have been observed."""
        values = self.complete[metric]
        return values.fillna(self.complete[CENSORED + metric.removeprefix(CONVERGED)]) if metric.startswith(CONVERGED) else values


def load(folder: str, labels: dict[str, str] | None = None) -> Results:
    """Reads the tables in a sweep's folder. `labels` replaces the labels of the experiment file."""
    settings = Store(folder).settings()
    if os.path.exists(os.path.join(folder, "study.db")) and not os.path.exists(os.path.join(folder, "runs.parquet")):
        raise ExperimentError(f"'{folder}' is the folder of a search, not of a sweep")
    read = {name: _read(folder, name) for name in ("runs", "series")}
    if os.path.exists(os.path.join(folder, "nodes.parquet")):
        read["nodes"] = _read(folder, "nodes")
    tables = {name: table for name, (table, _) in read.items()}
    results = Results(tables["runs"], tables["series"], tables.get("nodes"), settings["keys"], {}, settings.get("labels", {}) if labels is None else labels,
                      settings.get("zip", settings["keys"]))
    needed = {"run", "status", "seed", *results.keys, *(CENSORED + name.removeprefix(CONVERGED) for name in results.convergence_times)}
    columns = list(results.runs.columns)
    # Figures would combine the runs with different values of a key that is missing in the settings.
    if (not needed <= set(columns) or {*columns[1:columns.index("status")]} != {*results.keys, "seed"}
            or not {"run", "second", "links"} <= set(results.series.columns) or not results.runs["run"].is_unique):
        raise ExperimentError(f"the tables of '{folder}' are damaged or from an earlier version: write them again with ./collektive sweep EXPERIMENT.json "
                              f"--out {folder} --resume")
    if len({content for _, content in read.values()}) > 1:
        raise ExperimentError(f"the tables of '{folder}' do not belong together: if a sweep is writing them, try again; otherwise write them again with "
                              f"./collektive sweep EXPERIMENT.json --out {folder} --resume")
    # The settings may be newer than the tables, and list other metrics.
    def by_column(texts: dict[str, str]) -> dict[str, str]:
        return {column: texts[name] for column in results.metrics for name in (name_of_metric(column), column) if name in texts}

    return replace(results, units=by_column(settings["measure"]), labels={**results.labels, **by_column(results.labels)})


def name_of_metric(column: str) -> str:
    """Returns the name of the metric in a column. Tables add the prefix `metric.` to a name that is already taken."""
    return re.sub(r"^(metric\.)+", "", column)


def _read(folder: str, name: str) -> tuple[pd.DataFrame, bytes | None]:
    """Returns a table, and the metadata that all tables of a sweep share. Tables of earlier versions have none."""
    try:
        table = read_parquet(folder, name, page_checksum_verification=True)
        # By default, if a cell is empty, whole numbers become floats, which round numbers beyond 2^53, and booleans become objects, whose ~ is an integer.
        types = {pa.int64(): pd.Int64Dtype(), pa.uint64(): pd.UInt64Dtype(), pa.bool_(): pd.BooleanDtype()} if name == "nodes" else {}
        frame: pd.DataFrame = table.to_pandas(types_mapper=types.get)
        return frame, (table.schema.metadata or {}).get(CONTENT.encode())
    except (OSError, ValueError, NotImplementedError) as error:
        raise ExperimentError(f"'{folder}' has no usable {name}.parquet ({error}): if a sweep is writing the tables, try again; otherwise write them with "
                              f"./collektive sweep EXPERIMENT.json --out {folder} --resume") from error


def require_distinct(data: pd.DataFrame, keys: list[str]) -> None:
    """Raises `ValueError` if two runs in a table have the same seed and equal values of the keys. Combined tables may contain such runs."""
    if data.duplicated([*keys, "seed", *(["second"] if "second" in data else [])]).any():
        raise ValueError("two runs of a configuration have the same seed: add the column that distinguishes them to the keys of the results")


def compare(results: Results, metric: str, by: str) -> pd.DataFrame:
    """
    Compares the end values of a metric, or any other number in the table of runs, between each pair of values of a key. Like in figures, a name that a
    metric shares with another column means the metric.

    Returns a row for each pair of values `a` and `b`, and for each combination of the other keys. Runs with equal seeds are paired. A run that has not
    converged counts with its `censored` time. A row has these columns:
    - both means, and the `difference` of the means with its 95 % bootstrap interval from `difference_low` to `difference_high`;
    - the effect size `delta` with its interval: the probability that `b` has the greater value, minus the probability that it has the smaller one. It
      is between -1 and 1, and 0 means no effect. It compares pairs, or all runs if no seeds are equal (Cliff's delta);
    - `p`, the p-value of a permutation test of the difference, and `p_holm`, the same value corrected for all rows of the table;
    - `n_a` and `n_b`, the numbers of runs with a value, and `pairs`, the number of their pairs.
    With only one pair, or without pairs if one of the values has only one run, the statistics are NaN.
    """
    metric = results.column(metric)
    rows = []
    others = results.other_keys([by])
    # Combined tables may have keys with any names.
    if taken := {"a", "b", "n_a", "n_b", "pairs", *EFFECTS, "p_holm"}.intersection(others):
        raise ValueError(f"the key '{min(taken)}' has the name of a column of the comparison: rename the key")
    data = results.complete.assign(**{VALUE: results.values(metric)}).dropna(subset=VALUE)
    require_distinct(data, [*others, by])
    groups = data.groupby(others, sort=False, dropna=False) if others else [((), data)]
    for place, group in groups:
        samples = {value: part.set_index("seed")[VALUE] for value, part in group.groupby(by, sort=False)}
        # In the order of the experiment, even if the first run of a value is missing. Otherwise, the sign of effects would differ between rows.
        for first, second in itertools.combinations([value for value in results.runs[by].unique() if value in samples], 2):
            a, b = samples[first], samples[second]
            seeds = a.index.intersection(b.index)
            effect = (paired_effect(a[seeds].to_numpy(float), b[seeds].to_numpy(float)) if len(seeds) else
                      unpaired_effect(a.to_numpy(float), b.to_numpy(float)))
            rows.append({**dict(zip(others, place)), "a": first, "b": second, "n_a": len(a), "n_b": len(b), "pairs": len(seeds), **effect})
    table = pd.DataFrame(rows)
    return table if table.empty else table.assign(p_holm=holm(table["p"].to_numpy(float)))
