"""Tables of a sweep, as Parquet and CSV."""
import csv
import json
import os
from collections.abc import Callable, Iterable, Iterator
from types import TracebackType
from typing import Any

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq

from .experiment import text
from .store import PART, Store

BATCH = 2000
"""Rows that are kept in memory."""
COUNTS = ("links", "sent", "dropped", "delayed", "expired")
TIMES = ("sense_ms", "rules_ms", "step_ms", "act_ms", "physics_ms", "other_ms", "tick_ms", "tick_ms_p99")
RUN_COLUMNS: list[tuple[str, pa.DataType]] = [
    ("status", pa.string()), ("message", pa.string()), ("digest", pa.string()), ("nodes", pa.int64()), ("ticks", pa.int64()), ("errors", pa.int64())]
RUN_TIMES: list[tuple[str, pa.DataType]] = [
    ("wall_seconds", pa.float64()), ("ticks_ms", pa.float64()), ("tick_ms_median", pa.float64()), ("tick_ms_p99", pa.float64())]
VERSIONS = ("collektive", "jvm", "clr", "os")


class Table:
    """A table that is written row by row; the file appears when it is whole."""

    def __init__(self, path: str, schema: pa.Schema, with_csv: bool):
        self._schema = schema
        self._rows: list[dict[str, Any]] = []
        self._paths = [path + ".parquet"] + ([path + ".csv"] if with_csv else [])
        self._writers: list[Any] = [pq.ParquetWriter(self._paths[0] + PART, schema)]
        if with_csv:
            self._writers.append(pyarrow.csv.CSVWriter(self._paths[1] + PART, schema))

    def add(self, row: dict[str, Any]) -> None:
        """Adds a row; columns without a value are null."""
        self._rows.append(row)
        if len(self._rows) == BATCH:
            self._flush()

    def __enter__(self) -> "Table":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if error is None:
            self._flush()
        for writer in self._writers:
            writer.close()
        for path in self._paths:
            if error is None:
                os.replace(path + PART, path)
            else:
                os.remove(path + PART)

    def _flush(self) -> None:
        table = pa.Table.from_pylist(self._rows, schema=self._schema)
        for writer in self._writers:
            writer.write_table(table)
        self._rows = []


def write(store: Store, with_csv: bool) -> None:
    """Writes runs, series and, if runs have them, nodes, of all runs that have ended."""
    columns = _Columns(store)
    runs = pa.schema([("run", pa.string()), *columns.parameters, *RUN_COLUMNS, *((name, pa.float64()) for name in columns.metrics),
                      *((f"converged.{name}", pa.float64()) for name in columns.converged), *RUN_TIMES,
                      *((f"version.{name}", pa.string()) for name in VERSIONS)])
    series = pa.schema([("run", pa.string()), *columns.parameters, ("second", pa.float64()), *((name, pa.float64()) for name in columns.metrics),
                        *((name, pa.int64()) for name in COUNTS), *((name, pa.float64()) for name in TIMES)])
    with Table(os.path.join(store.folder, "runs"), runs, with_csv) as run_table, Table(os.path.join(store.folder, "series"), series, with_csv) as series_table:
        for record in store.records():
            first = {"run": record["name"], **columns.values(record)}
            run_table.add({**first, **columns.results(record)})
            if record["status"] == "complete":
                for row in columns.series(record):
                    series_table.add({**first, **row})
    if columns.nodes:
        nodes = pa.schema([("run", pa.string()), *columns.parameters, ("second", pa.float64()), ("node", pa.int64()), *columns.nodes.items()])
        with Table(os.path.join(store.folder, "nodes"), nodes, with_csv) as node_table:
            for record in store.records():
                if record["status"] == "complete":
                    first = {"run": record["name"], **columns.values(record)}
                    for row in columns.node_rows(record):
                        node_table.add({**first, **row})


class _Columns:
    """Which columns the tables have, from what is in the folder, and their values."""

    def __init__(self, store: Store):
        self._store = store
        asked = store.asked()
        values: dict[str, list[Any]] = {key: [] for key in asked["keys"]}
        metrics: dict[str, None] = {}
        converged: dict[str, None] = {}
        self.nodes: dict[str, pa.DataType] = {}
        for record in store.records():
            for key, value in record["values"].items():
                if value not in values[key]:
                    values[key].append(value)
            manifest = self._manifest(record)
            metrics.update(dict.fromkeys(manifest.get("end", {})))
            converged.update(dict.fromkeys(manifest.get("converged", {})))
            self._add_node_columns(record)
        types = {key: _type_of(values[key]) for key in values}
        if "seed" not in types:
            types["seed"] = pa.uint64()
        self.parameters: list[tuple[str, pa.DataType]] = list(types.items())
        self._names = {name: "metric." + name if name in self._taken() else name for name in metrics if not asked["measure"] or name in asked["measure"]}
        self.metrics = list(self._names.values())
        self.converged = list(converged)

    def values(self, record: dict[str, Any]) -> dict[str, Any]:
        """The run's parameters; the seed also when it does not vary."""
        seed = self._manifest(record).get("scenario", {}).get("seed")
        found = {"seed": seed, **record["values"]}
        return {key: text(found[key]) if kind == pa.string() and found.get(key) is not None else found.get(key) for key, kind in self.parameters}

    def results(self, record: dict[str, Any]) -> dict[str, Any]:
        """The rest of the run's row. A run that was not complete has no results: they would be of half a run."""
        row = {"status": record["status"], "message": record["message"] or None}
        if record["status"] != "complete":
            return row
        manifest = self._manifest(record)
        row |= {name: manifest.get(name) for name in ("digest", "nodes", "ticks", "errors", *(name for name, _ in RUN_TIMES))}
        row |= {column: _number(manifest["end"].get(name)) for name, column in self._names.items()}
        row |= {f"converged.{name}": manifest["converged"].get(name) for name in self.converged}
        row |= {f"version.{name}": manifest["versions"].get(name) for name in VERSIONS}
        return row

    def series(self, record: dict[str, Any]) -> Iterator[dict[str, Any]]:
        """The rows of metrics.csv."""
        for row in self._rows(record, "metrics.csv"):
            yield {"second": float(row["second"]), **{column: _number(row.get(name)) for name, column in self._names.items()},
                   **{name: int(row[name]) for name in COUNTS}, **{name: float(row[name]) for name in TIMES}}

    def node_rows(self, record: dict[str, Any]) -> Iterator[dict[str, Any]]:
        """The rows of nodes.csv."""
        convert: dict[str, Callable[[str], Any]] = {
            name: (lambda cell: cell == "true") if kind == pa.bool_() else float if kind == pa.float64() else str for name, kind in self.nodes.items()}
        for row in self._rows(record, "nodes.csv"):
            yield {"second": float(row["second"]), "node": int(row["node"]), **{name: convert[name](row[name]) for name in convert if row.get(name)}}

    def _add_node_columns(self, record: dict[str, Any]) -> None:
        """A column's type is that of its first cell with a value."""
        if not os.path.exists(os.path.join(self._store.runs, record["name"], "nodes.csv")) or (self.nodes and pa.null() not in self.nodes.values()):
            return
        for row in self._rows(record, "nodes.csv"):
            for name, cell in list(row.items())[2:]:
                if self.nodes.setdefault(name, pa.null()) == pa.null() and cell:
                    self.nodes[name] = pa.bool_() if cell in ("true", "false") else pa.float64() if _is_number(cell) else pa.string()
            if pa.null() not in self.nodes.values():
                return

    def _taken(self) -> set[str]:
        return {"run", "second", *(name for name, _ in self.parameters), *(name for name, _ in RUN_COLUMNS + RUN_TIMES), *COUNTS, *TIMES}

    def _manifest(self, record: dict[str, Any]) -> dict[str, Any]:
        try:
            with open(os.path.join(self._store.runs, record["name"], "manifest.json")) as file:
                manifest: dict[str, Any] = json.load(file)
        except FileNotFoundError:
            return {}
        return manifest

    def _rows(self, record: dict[str, Any], name: str) -> Iterable[dict[str, str]]:
        with open(os.path.join(self._store.runs, record["name"], name), newline="") as file:
            yield from csv.DictReader(file)


def _type_of(values: list[Any]) -> pa.DataType:
    if values and all(isinstance(value, bool) for value in values):
        return pa.bool_()
    if any(isinstance(value, (bool, str, list)) for value in values) or not values:
        return pa.string()
    if all(isinstance(value, int) for value in values):
        return pa.uint64() if max(values) >= 1 << 63 else pa.int64()
    return pa.float64()


def _number(value: Any) -> float | None:
    """A metric; JSON has NaN and infinity as text."""
    return None if value is None or value == "" else float(str(value).replace("∞", "inf"))


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
