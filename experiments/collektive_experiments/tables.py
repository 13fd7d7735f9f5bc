"""Writes the tables of a sweep as Parquet and CSV."""
import csv
import hashlib
import json
import math
import os
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq

from . import files
from .bundle import require_unchanged
from .experiment import Experiment, Run, text
from .figure_options import CENSORED, CONVERGED
from .positions import ExperimentError
from .store import Store
from .worker import TIMES

BATCH = 2000
"""The number of rows that are kept in memory before they are written."""
COUNTS = ("links", "sent", "dropped", "delayed", "expired")
RUN_COLUMNS: list[tuple[str, pa.DataType]] = [
    ("status", pa.string()), ("message", pa.string()), ("digest", pa.string()), ("nodes", pa.int64()), ("ticks", pa.int64()), ("errors", pa.int64())]
RUN_TIMES: list[tuple[str, pa.DataType]] = [
    ("wall_seconds", pa.float64()), ("ticks_ms", pa.float64()), ("tick_ms_median", pa.float64()), ("tick_ms_p99", pa.float64())]
VERSIONS = ("collektive", "jvm", "clr", "os")
NODE_TYPES = {"bool": pa.bool_(), "int64": pa.int64(), "uint64": pa.uint64(), "float64": pa.float64(), "string": pa.string()}

CONTENT = "collektive.content"
"""The metadata of Parquet tables that identifies their common content."""

CELL = re.compile(r'("(?:[^"]|"")*+"|[^",\n]*+)[,\n]')
"""A cell of a CSV file, with its quotes."""

WITHOUT_EFFECT = ("threads", "stepLimitMs", "runtime", "jvm", "outputs")
"""Keys of the scenario on which results should not depend, or that change only which results are written."""

Record = dict[str, Any]


class Table:
    """A table that is written row by row. `publish` gives it its final name."""

    def __init__(self, path: str, schema: pa.Schema, with_csv: bool):
        self._schema = schema
        self._rows: list[dict[str, Any]] = []
        self._paths = [path + ".parquet"] + ([path + ".csv"] if with_csv else [])
        self._files = [files.create(path) for path in self._paths]
        self._writers: list[Any] = [pq.ParquetWriter(self._files[0], schema, write_page_checksum=True)]
        if with_csv:
            self._writers.append(pyarrow.csv.CSVWriter(self._files[1], schema))

    def add(self, row: dict[str, Any]) -> None:
        """Adds a row. Columns without a value are null."""
        self._rows.append(row)
        if len(self._rows) == BATCH:
            self._flush()

    def __enter__(self) -> "Table":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        try:
            if error is None:
                self._flush()
            for writer in self._writers:
                writer.close()
            # `publish` also syncs, but a full disk must be reported before the earlier tables are deleted.
            for file in self._files:
                file.flush()
                os.fsync(file.fileno())
        finally:
            # After an interruption, `__del__` would print an error, because the file is closed.
            self._writers[0].is_open = False
            for file in self._files:
                file.close()

    def publish(self) -> None:
        """Replaces the earlier table. Call it after the end of the `with` block."""
        for path in self._paths:
            files.publish(path)

    def _flush(self) -> None:
        table = pa.Table.from_pylist(self._rows, schema=self._schema)
        for writer in self._writers:
            writer.write_table(table)
        self._rows = []


def write(experiment: Experiment, store: Store, with_csv: bool) -> int:
    """
    Writes the tables of all finished runs. Returns the number of runs that the tables contain completely.

    Raises `ExperimentError` if the sweep's inputs were changed since its first run.
    """
    store.require_owned()
    require_unchanged(store.bundle)
    columns = _Columns(experiment, store)
    # Existing CSV tables are always written again, so that they do not become outdated.
    with_csv = with_csv or any(os.path.exists(os.path.join(store.folder, f"{name}.csv")) for name in ("runs", "series", "nodes"))
    runs = pa.schema([("run", pa.string()), *columns.parameters, *RUN_COLUMNS, *((name, pa.float64()) for name in columns.metrics),
                      *((prefix + name, pa.float64()) for name in columns.converged for prefix in (CONVERGED, CENSORED)), *RUN_TIMES,
                      *((f"version.{name}", pa.string()) for name in VERSIONS)])
    series = pa.schema([("run", pa.string()), *columns.parameters, ("second", pa.float64()), *((name, pa.float64()) for name in columns.metrics),
                        *((name, pa.int64()) for name in COUNTS), *((name, pa.float64()) for name in TIMES)])
    schemas = {"runs": runs, "series": series}
    if columns.nodes:
        schemas["nodes"] = pa.schema([("run", pa.string()), *columns.parameters, ("second", pa.float64()), ("node", pa.int64()), *columns.nodes.items()])
    content = {CONTENT: hashlib.sha256(f"{schemas}{columns.files}".encode()).hexdigest()}
    with ExitStack() as stack:
        opened = {name: stack.enter_context(Table(os.path.join(store.folder, name), schema.with_metadata(content), with_csv))
                  for name, schema in schemas.items()}
        for run, record in columns.records():
            first = {"run": run.name, **columns.values(run)}
            if record["status"] == "complete":
                for row in columns.series(run):
                    opened["series"].add({**first, **row})
                for row in columns.node_rows(run) if columns.nodes else ():
                    opened["nodes"].add({**first, **row})
            opened["runs"].add({**first, **columns.results(run, record)})
    # All tables must contain the same runs, even if writing one of them fails. After a kill between two steps, runs.parquet is missing.
    for name in ("runs", "nodes"):
        for ending in (".parquet", ".csv"):
            Path(store.folder, name + ending).unlink(missing_ok=True)
    for table in reversed(opened.values()):
        table.publish()
    columns.warn()
    _warn_of_different_jvms(store)
    _warn_of_keys_without_effect(experiment, store, ["digest", *columns.metrics, *(CONVERGED + name for name in columns.converged)])
    return _count_rows(experiment, store, columns.rows)


def check_columns(store: Store, run: Run) -> None:
    """Raises `ExperimentError` if the metrics.csv of a complete run has the columns of another version."""
    _metric_names(run, next(_lines(store, run), []))


def read_parquet(folder: str, name: str, **options: Any) -> pa.Table:
    """Reads a table of a sweep with the given options of PyArrow."""
    # PyArrow would replace `~` in a relative path by the home folder, and remove `..` with a symbolic link before it.
    return pq.read_table(os.path.realpath(os.path.join(folder, f"{name}.parquet")), **options)


def _count_rows(experiment: Experiment, store: Store, rows: dict[str, int]) -> int:
    """Returns the number of runs whose files are unchanged, and that have one row in runs.parquet and all rows in series.parquet."""
    written, series = (Counter(read_parquet(store.folder, name, columns=["run"])["run"].to_pylist()) for name in ("runs", "series"))
    return sum(written[run.name] == 1 and series[run.name] == rows.get(run.name, 0)
               and (record := store.record(run)) is not None and not store.changed_files(run, record) for run in experiment.runs())


def _warn_of_different_jvms(store: Store) -> None:
    """Prints a warning if a sweep was resumed with another JVM, or nodes of a cluster have different ones."""
    jvms = sorted({*read_parquet(store.folder, "runs", columns=["version.jvm"])["version.jvm"].to_pylist()} - {None})
    if len(jvms) > 1:
        print(f"collektive: the runs have {len(jvms)} values of version.jvm ({', '.join(map(repr, jvms))}), so results of functions such as Math.sin can "
              "differ between them", file=sys.stderr)


def _warn_of_keys_without_effect(experiment: Experiment, store: Store, results: list[str]) -> None:
    """Prints a warning about each varied key without an effect on the results, such as `timing.period` if the schedule is not asynchronous."""
    # PyArrow's group_by would load a module that `./collektive clean` may have removed since the sweep began.
    runs = read_parquet(store.folder, "runs").select([*experiment.keys, *results, "status"])
    count = len(experiment.keys)
    rows = [(row[:count], row[count:-1]) for row in zip(*(column.to_pylist() for column in runs.columns)) if row[-1] == "complete"]
    # Keys of `zip` can have an effect only together.
    for keys in (*([key] for key, _ in experiment.product), [key for key, _ in experiment.together]):
        if all(key.split(".")[0] in WITHOUT_EFFECT for key in keys):
            continue
        groups: dict[tuple[Any, ...], set[tuple[Any, ...]]] = {}
        for values, found in rows:
            groups.setdefault(tuple(value for key, value in zip(experiment.keys, values) if key not in keys), set()).add(found)
        if len(groups) < len(rows) and all(len(found) == 1 for found in groups.values()):
            names = " and ".join(f"'{key}'" for key in keys)
            print(f"collektive: runs that differ only in {names} have equal results", file=sys.stderr)


class _Columns:
    """The columns of the tables and their values."""

    def __init__(self, experiment: Experiment, store: Store):
        self._experiment = experiment
        self._store = store
        self._not_finite: dict[str, set[str]] = {}
        metrics: dict[str, None] = {}
        converged: dict[str, None] = {}
        self.rows: dict[str, int] = {}
        self._seconds: list[float] = []
        node_columns: dict[str, str] = {}
        self.files: list[tuple[str, dict[str, str]]] = []
        for run, record in self.records():
            self.files.append((run.name, record["files"]))
            manifest = self._manifest(run)
            metrics.update(dict.fromkeys(manifest.get("end", {})))
            converged.update(dict.fromkeys(manifest.get("converged", {})))
            node_columns.update(manifest.get("node_columns", {}))
        types = {key: _type_of(values) for key, values in experiment.product + experiment.together}
        # With other types in some sweeps, pandas would round the seeds of combined tables.
        if types.get("seed", pa.int64()) == pa.int64():
            types["seed"] = pa.uint64()
        self.parameters: list[tuple[str, pa.DataType]] = list(types.items())
        self.nodes: dict[str, pa.DataType] = {self._node_column(name): NODE_TYPES[kind] for name, kind in node_columns.items()}
        self._names: dict[str, str] = {}
        taken = {"run", "second", *types, *(name for name, _ in RUN_COLUMNS + RUN_TIMES), *COUNTS, *TIMES, *(f"version.{name}" for name in VERSIONS),
                 *(prefix + name for name in converged for prefix in (CONVERGED, CENSORED))}
        for name in experiment.measure or metrics:
            column = name
            while column in taken or column.startswith((CONVERGED, CENSORED, "version.")):
                column = "metric." + column
            taken.add(column)
            self._names[name] = column
        self.metrics = list(self._names.values())
        self.converged = list(converged)

    def records(self) -> Iterator[tuple[Run, Record]]:
        """Yields the finished runs in the experiment's order with the content of their run.json."""
        for run in self._experiment.runs():
            if record := self._store.record(run):
                yield run, record

    def values(self, run: Run) -> dict[str, Any]:
        """Returns the parameters of a run. These always include the seed."""
        found = {"seed": self._experiment.seed, **run.values}
        return {key: _value(found.get(key), kind) for key, kind in self.parameters}

    def results(self, run: Run, record: Record) -> dict[str, Any]:
        """Returns the other columns of a run's row. The series of the run must be read first. An incomplete run has no results."""
        row = {"status": record["status"], "message": record["message"] or None}
        if record["status"] != "complete":
            return row
        manifest = self._manifest(run)
        if not {"end", "converged", "versions"} <= manifest.keys():
            raise ExperimentError(f"the manifest of '{run.name}' was changed: repeat the run with --resume")
        row |= {name: manifest.get(name) for name in ("digest", "nodes", "ticks", "errors", *(name for name, _ in RUN_TIMES))}
        row |= {column: self._number(run, name, manifest["end"].get(name)) for name, column in self._names.items()}
        for name in self.converged:
            row[CONVERGED + name] = time = manifest["converged"].get(name)
            if time is None and name in manifest["converged"]:
                row[CENSORED + name] = self._latest_start(manifest["scenario"]["converged"][name]["seconds"], manifest["scenario"]["deltaTime"])
        row |= {f"version.{name}": manifest["versions"].get(name) for name in VERSIONS}
        return row

    def series(self, run: Run) -> Iterator[dict[str, Any]]:
        """Yields the rows of metrics.csv, with the second, metrics, counts and times."""
        table = _lines(self._store, run)
        names = _metric_names(run, next(table, []))
        self.rows[run.name] = 0
        self._seconds = []
        for cells in table:
            metrics = dict(zip(names, cells[1:]))
            rest = cells[1 + len(names):]
            self.rows[run.name] += 1
            second = float(cells[0])
            self._seconds.append(second)
            # At second 0, missing values are normal, because many metrics need answers.
            yield {"second": second, **{column: self._number(run, name, metrics.get(name), warns=second > 0) for name, column in self._names.items()},
                   **{name: int(cell) for name, cell in zip(COUNTS, rest)}, **{name: float(cell) for name, cell in zip(TIMES, rest[len(COUNTS):])}}

    def _latest_start(self, seconds: float, tick: float) -> float:
        """Returns the latest second at which a period in a band can begin that counts as convergence in the run whose series was read last."""
        end = self._seconds[-1]
        # The player accepts periods that are shorter because rows are written at ticks, as in Convergence.cs.
        shortest = max(seconds * (1 - 5e-5), seconds - tick / 2)
        return max(0.0, round(end - seconds, 6), *(second for second in self._seconds if end - second >= shortest))

    def node_rows(self, run: Run) -> Iterator[dict[str, Any]]:
        """Yields the rows of nodes.csv."""
        convert: dict[str, Callable[[str], Any]] = {
            name: (lambda cell: cell == "true") if kind == pa.bool_() else float if kind == pa.float64() else _unquoted if kind == pa.string() else int
            for name, kind in self.nodes.items()}
        path = os.path.join(self._store.runs, run.name, "nodes.csv")
        if not os.path.exists(path):
            return
        with open(path, newline="\n", encoding="utf-8") as file:
            names = [self._node_column(name) for name in next(file).rstrip("\n").split(",")[2:]]
            lines: list[str] = []
            quotes = 0
            for line in file:
                lines.append(line)
                quotes += line.count('"')
                # Within a text, the number of quotes is odd.
                if quotes % 2:
                    continue
                # The csv module cannot distinguish a missing answer from an empty text, which has quotes.
                cells = CELL.findall("".join(lines))
                lines = []
                yield {"second": float(cells[0]), "node": int(cells[1]), **{name: convert[name](cell) for name, cell in zip(names, cells[2:]) if cell}}

    def warn(self) -> None:
        """Prints a warning about metrics that are NaN or infinite, because their cells are empty."""
        for name, runs in self._not_finite.items():
            print(f"collektive: the metric '{name}' is NaN or infinite in {len(runs)} runs, such as '{min(runs)}'; these cells are empty", file=sys.stderr)

    def _number(self, run: Run, name: str, value: Any, warns: bool = True) -> float | None:
        """Returns a metric, or None if it is not finite. The player writes NaN and infinity as text."""
        if value is None or value == "":
            return None
        number = _finite(str(value).replace("∞", "inf"))
        if number is None and warns:
            self._not_finite.setdefault(name, set()).add(run.name)
        return number

    def _node_column(self, field: str) -> str:
        """Returns the column of a field. If another column has the field's name, adds the prefix `field.` to it."""
        taken = {"run", *(name for name, _ in self.parameters)}
        return "field." + field if field in taken else field

    def _manifest(self, run: Run) -> dict[str, Any]:
        try:
            with open(os.path.join(self._store.runs, run.name, "manifest.json"), "rb") as file:
                manifest: dict[str, Any] = json.loads(file.read())
        except (FileNotFoundError, IsADirectoryError, ValueError):
            return {}
        return manifest


def _lines(store: Store, run: Run) -> Iterator[list[str]]:
    """Yields the lines of metrics.csv."""
    with open(os.path.join(store.runs, run.name, "metrics.csv"), newline="", encoding="utf-8") as file:
        yield from csv.reader(file)


def _metric_names(run: Run, header: list[str]) -> list[str]:
    """Returns the names of the metrics in the header of metrics.csv."""
    names = header[1:-len(COUNTS + TIMES)]
    # Runs of earlier versions have other columns, and their values would be in the wrong columns of the table.
    if header != ["second", *names, *COUNTS, *TIMES]:
        raise ExperimentError(f"metrics.csv of '{run.name}' is damaged or of another version: name another folder with --out")
    return names


def _type_of(values: list[Any]) -> pa.DataType:
    if values and all(isinstance(value, bool) for value in values):
        return pa.bool_()
    if any(isinstance(value, (bool, str, list)) for value in values) or not values:
        return pa.string()
    if any(isinstance(value, float) for value in values) or min(values) < -1 << 63 or max(values) >= (1 << 63 if min(values) < 0 else 1 << 64):
        # Different whole numbers beyond 2^53 could have the same float.
        return pa.float64() if all(float(value) == value for value in values) else pa.string()
    return pa.uint64() if max(values) >= 1 << 63 else pa.int64()


def _value(value: Any, kind: pa.DataType) -> Any:
    """Converts a parameter to the type of its column."""
    return None if value is None else text(value) if kind == pa.string() else float(value) if kind == pa.float64() else value


def _unquoted(cell: str) -> str:
    return cell[1:-1].replace('""', '"')


def _finite(cell: str) -> float | None:
    number = float(cell)
    return number if math.isfinite(number) else None
