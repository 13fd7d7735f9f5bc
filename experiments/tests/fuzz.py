"""
Tests sweeps, tables and plots with random experiments: `fuzz.py SECONDS SEED FINDINGS`.

The tables are compared with a model of their rows. The experiment and the results of each failed case stay in a folder, whose name consists of FINDINGS
and the number of the case.
"""
import contextlib
import hashlib
import io
import itertools
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd

from collektive_experiments import ExperimentError, read
from collektive_experiments.__main__ import main
from collektive_experiments.experiment import identity, text
from collektive_experiments.files import MARKER

PROJECT = Path(__file__).parent / "fuzz"
BUILD = Path(__file__).resolve().parents[2] / "build"
TEXTS = ["", " ", "a,b", "a=b,c", "x.part", "../../up", "a/b", '"', "two\nlines", "\u00fcn\u00ef\U0001f680", "true", "1", "01", "1.0", "_under", "$x$",
         "<script>", "NaN", "null", "'", "\\", "y" * 300, "#", "%s{}", "\t", "\u2028", "-inf", "a|b"]
NAMES = [*(text for text in TEXTS if text and "|" not in text), "status", "run", "digest", "seed", "node", "converged.one", "version.jvm", "metric.run"]
NUMBERS = [0, 1, -1, 2.5, 1e-7, 1e12, -3.25, 1 << 53, 123456789.125, 1 << 63, 7.0]
DEFAULTS: dict[str, Any] = {"fields.names": "one", "fields.nodes": 2, "fields.slope": 1, "fields.odd": "", "fields.label": "", "fields.flag": False,
                            "fields.place": [0, 0, 0], "fields.fate": 0, "seconds": 2, "deltaTime": 0.5, "outputs.interval": 1, "seed": 1}
VALUES: dict[str, list[Any]] = {
    "fields.slope": NUMBERS, "fields.label": TEXTS, "fields.flag": [True, False], "fields.place": [[0, 0, 0], [1.5, -2, 3], [1, 2, 3]],
    "fields.nodes": [1, 2, 5], "fields.fate": [0, 0, 0, 1, 2], "fields.odd": ["", "nan", "inf"], "seed": [0, 1, 2, 7, (1 << 64) - 1],
    "seconds": [0.5, 1, 2, 3], "deltaTime": [0.5, 0.25, 0.3, 0.4, 0.3333333333], "outputs.interval": [0.5, 1, 2]}
INSERTIONS = [b"[" * 5000, b"9" * 5000, b"\\ud800", b"\xff\xfe", b"//", b"/*", b"{", b"}", b",", b'"', b"1e400", b"\0", b"-", b"NaN", b"\n"]
MAX_RUNS = 12


class Case:
    """A random experiment, and a model of the rows that the sweep's tables must have."""

    def __init__(self, chance: random.Random):
        self.chance = chance
        keys = chance.sample(sorted(VALUES), chance.randint(1, 5))
        self.root: dict[str, Any] = {"version": 1, "scenario": str(PROJECT / "scenario.json"), "vary": {}, "zip": {}, "set": {}}
        size = chance.randint(1, 3)
        for key in keys:
            part = chance.choice(["vary", "vary", "zip", "set"])
            values = self._distinct(key)
            if part == "vary":
                self.root["vary"][key] = values[:chance.randint(1, 3)]
            elif part == "zip" and len(values) >= size:
                self.root["zip"][key] = values[:size]
            else:
                self.root["set"][key] = values[0]
        if not self.root["zip"] and not {"deltaTime", "outputs.interval"} & set(keys) and chance.random() < 0.3:
            # These keys vary together, because the first interval would be invalid with the second tick length.
            self.root["zip"] = {"deltaTime": [0.5, 1.5], "outputs.interval": [0.5, 1.5]}
        while self._count() > MAX_RUNS:
            key = chance.choice([key for key, values in self.root["vary"].items() if len(values) > 1])
            self.root["vary"][key].pop()
        names = chance.sample(NAMES, chance.randint(1, 4))
        self.root["set"]["fields.names"] = "|".join(names)
        if chance.random() < 0.3:
            self.root["set"]["fields"] = {"names": "other", "label": "object"}
        if chance.random() < 0.3:
            self.root["set"]["outputs.nodes"] = {"fields": ["level", "name", "position"], "interval": 1.5}
        if chance.random() < 0.5:
            measured = chance.sample(names, chance.randint(1, len(names)))
            self.root["measure"] = measured if chance.random() < 0.5 else {name: chance.choice(TEXTS) for name in measured}

    def _distinct(self, key: str) -> list[Any]:
        chosen = {identity(value): value for value in self.chance.sample(VALUES[key], len(VALUES[key]))}
        return list(chosen.values())

    def _count(self) -> int:
        return math.prod(len(values) for values in self.root["vary"].values()) * max([1, *(len(values) for values in self.root["zip"].values())])

    def grow(self) -> bool:
        """Adds a value to a key, which is allowed with `--resume`. Returns whether it added one."""
        for key, values in self.root["vary"].items():
            more = [value for value in self._distinct(key) if identity(value) not in map(identity, values)]
            if more and self._count() // len(values) * (len(values) + 1) <= MAX_RUNS:
                values.append(more[0])
                return True
        return False

    def text(self) -> str:
        """Returns the content of the experiment file, in one of the forms of JSON that the player accepts."""
        written = json.dumps(self.root, indent=self.chance.choice([None, 1]), ensure_ascii=self.chance.random() < 0.5)
        if self.chance.random() < 0.5:
            written = "// a comment\n" + written[:-1] + ", /* the end */ }"
        return ("\ufeff" if self.chance.random() < 0.3 else "") + written

    def runs(self) -> list[dict[str, Any]]:
        """Returns the values of the keys that vary, for each run."""
        vary, together = self.root["vary"], self.root["zip"]
        rows = [dict(zip(together, row)) for row in zip(*together.values())] or [{}]
        return [{**dict(zip(vary, chosen)), **row} for chosen in itertools.product(*vary.values()) for row in rows]

    def settings(self, values: dict[str, Any]) -> dict[str, Any]:
        """Returns all keys of a run with these values. Keys inside an object override the object's values."""
        fixed = self.root["set"]
        return {**DEFAULTS, **{f"fields.{key}": value for key, value in fixed.get("fields", {}).items()}, **fixed, **values}

    def measured(self) -> list[str]:
        """Returns the metrics that the tables must contain."""
        return list(self.root.get("measure") or self.root["set"]["fields.names"].split("|"))


def metrics_at(settings: dict[str, Any], second: float) -> dict[str, float]:
    """Computes the scene's metrics in the same way as FuzzScene.cs."""
    names = settings["fields.names"].split("|")
    offset = second + len(settings["fields.label"].encode("utf-16-le")) // 2 + 100 * settings["fields.flag"] + settings["fields.place"][0]
    values = {name: settings["fields.slope"] * (index + 1) + offset for index, name in enumerate(names)}
    if settings["fields.odd"] == "nan":
        values[names[0]] = math.nan
    if settings["fields.odd"] == "inf":
        values[names[-1]] = -math.inf
    return values


def ticks(settings: dict[str, Any]) -> int:
    """Returns the number of ticks in a run."""
    return max(1, round(settings["seconds"] / settings["deltaTime"]))


def seconds_of_rows(settings: dict[str, Any], interval: float) -> list[float]:
    """Returns the times of a table's rows. The row of an interval is written in the first tick at or after the end of the interval."""
    whole = (math.ceil(index * interval / settings["deltaTime"] - 1e-5) for index in itertools.count())
    return [second_of(settings, tick) for tick in itertools.takewhile(lambda tick: tick <= ticks(settings), whole)]


def second_of(settings: dict[str, Any], tick: int) -> float:
    """Returns the simulated time after a tick, rounded to seven digits."""
    return tick * float(f"{settings['deltaTime']:.7g}")


def require(condition: bool, message: str) -> None:
    if not condition:
        raise AssertionError(message)


def require_close(found: Any, expected: float, what: str) -> None:
    if not math.isfinite(expected):
        require(bool(pd.isna(found)), f"{what} is {found}, not empty")
    else:
        require(math.isclose(found, expected, rel_tol=1e-12, abs_tol=1e-9), f"{what} is {found}, not {expected}")


def check(case: Case, out: Path) -> None:
    """Compares the tables of a sweep with the model."""
    runs, series = pd.read_parquet(out / "runs.parquet"), pd.read_parquet(out / "series.parquet")
    expected = case.runs()
    require(len(runs) == len(expected) == len(set(runs["run"])), f"the table must have a row for each of {len(expected)} runs, but has {len(runs)} rows")
    columns = list(series.columns)
    metrics = columns[columns.index("second") + 1:columns.index("links")]
    # If no run is complete, the metrics are known only if the experiment lists them.
    is_known = "measure" in case.root or "complete" in set(runs["status"])
    require(len(metrics) == len(case.measured()) or not is_known, f"the columns are {metrics}, but the metrics are {case.measured()}")
    nodes = pd.read_parquet(out / "nodes.parquet") if (out / "nodes.parquet").exists() else None
    for (_, row), values in zip(runs.iterrows(), expected):
        settings = case.settings(values)
        is_complete = settings["fields.fate"] == 0
        require(row["status"] == ("complete" if is_complete else "failed"), f"{row['run']} is {row['status']}: {row['message']}")
        for key, value in values.items():
            found = row[key]
            same = found == text(value) if isinstance(found, str) else float(found) == float(value)
            require(bool(same), f"{key} is {found!r}, not {value!r}")
        mine = series[series["run"] == row["run"]]
        seconds = seconds_of_rows(settings, settings["outputs.interval"]) if is_complete else []
        require(mine["second"].tolist() == [round(second, 6) for second in seconds], f"{row['run']} has the seconds {mine['second'].tolist()}, not {seconds}")
        for name, column in zip(case.measured(), metrics):
            if is_complete:
                require_close(row[column], metrics_at(settings, second_of(settings, ticks(settings)))[name], f"{column} at the end of {row['run']}")
            for second, found in zip(seconds, mine[column]):
                require_close(found, metrics_at(settings, second)[name], f"{column} at {second} of {row['run']}")
        if "outputs.nodes" in case.root["set"] and is_complete:
            require(nodes is not None, "the table of nodes is missing")
            assert nodes is not None
            cells = nodes[nodes["run"] == row["run"]]
            require(cells["second"].tolist() == [round(second, 6) for second in seconds_of_rows(settings, 1.5) for _ in range(settings["fields.nodes"])],
                    f"the nodes' rows of {row['run']} are at {cells['second'].tolist()}")
            require(set(cells["name"].dropna()) <= {"007"}, f"names of nodes are {set(cells['name'])}")


def run_command(*words: str) -> tuple[int, str]:
    """Runs a command of the package. Returns its exit code and its standard error."""
    errors = io.StringIO()
    with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
        code = main(list(words))
    return code, errors.getvalue()


def damage(chance: random.Random, out: Path) -> int:
    """Damages the results of random runs. Returns the number of finished runs that must be repeated."""
    folders = sorted((out / "runs").iterdir())
    chosen = chance.sample(folders, chance.randint(1, len(folders)))
    count = 0
    for folder in chosen:
        path = folder / chance.choice(sorted(set(os.listdir(folder)) - {MARKER}))
        content = path.read_bytes()
        # At least two bytes are removed, because the JSON would still be valid without its last line feed.
        changed = chance.choice([b"", content[:len(content) // 2], content[:-2], b"\0" * len(content), b"[" * 100_000, None])
        if changed == content:
            continue
        if changed is None:
            path.unlink()
        else:
            path.write_bytes(changed)
        count += 1
    if chance.random() < 0.3:
        (out / "sweep.json").write_bytes(b"")
    if chance.random() < 0.3:
        unfinished = out / "runs/left,over=1-0.part"
        unfinished.mkdir()
        (unfinished / MARKER).touch()
        (unfinished / "manifest.json").write_text("{")
    return count


def mutate(chance: random.Random, content: bytes, path: Path) -> None:
    """Reads damaged forms of an experiment file. Each form must be valid, or be rejected with a one-line error."""
    for _ in range(30):
        changed = bytearray(content)
        for _ in range(chance.randint(1, 4)):
            at = chance.randrange(len(changed))
            kind = chance.randrange(4)
            if kind == 0:
                changed[at] = chance.randrange(256)
            elif kind == 1:
                del changed[at:at + chance.randint(1, 20)]
            elif kind == 2:
                changed[at:at] = chance.choice(INSERTIONS)
            else:
                changed[at:at] = changed[at:at + chance.randint(1, 50)]
            changed = changed or bytearray(b" ")
        path.write_bytes(changed)
        try:
            read(str(path))
        except ExperimentError:
            code, errors = run_command("sweep", str(path), "--out", str(path.parent / "none"))
            require(code == 1 and errors.startswith("collektive: ") and errors.count("\n") == 1, f"the error must have one line: {errors}")
            require(not (path.parent / "none").exists(), "an invalid experiment must not create its folder")


def try_case(case: Case, folder: Path) -> None:
    """Runs a sweep of an experiment, damages its results, resumes it and plots it."""
    chance, path, out = case.chance, folder / "experiment.json", folder / "out"
    fails = any(case.settings(values)["fields.fate"] for values in case.runs())
    words = ["sweep", str(path), "--out", str(out), "--jobs", "2", "--keep-going", *(["--csv"] if chance.random() < 0.3 else [])]

    def sweep(*more: str) -> str:
        path.write_text(case.text(), encoding="utf-8")
        code, errors = run_command(*words, *more)
        require(code == int(fails) and "Traceback" not in errors, f"exit code {code}: {errors}")
        require(not any(name.endswith(".part") for name in os.listdir(out / "runs")), "no unfinished folder may remain")
        check(case, out)
        return errors

    sweep()
    if chance.random() < 0.5:
        count = damage(chance, out)
        require(sweep("--resume").count("is damaged; repeating the run") == count, f"the sweep must report {count} damaged runs")
    if chance.random() < 0.4 and case.grow():
        fails = any(case.settings(values)["fields.fate"] for values in case.runs())
        sweep("--resume")
    if chance.random() < 0.3:
        code, errors = run_command("plot", str(out))
        is_any_complete = "complete" in set(pd.read_parquet(out / "runs.parquet")["status"])
        require(code == int(not is_any_complete), f"plot: exit code {code}: {errors}")
        if is_any_complete:
            page = (out / "figures.html").read_text(encoding="utf-8")
            require("<script" not in page and "Content-Security-Policy" in page, "the page must not allow scripts")
            require({path.parent for path in out.glob("**/*.svg")} == {out / "figures"}, "all figures must be in the folder figures")
    mutate(chance, case.text().encode(), folder / "changed.json")


def run_failing(at: int, folder: Path, *words: str) -> tuple[int, int]:
    """Runs a command in which one call fails. Returns its exit code and the number of calls that could have failed.

    These calls are writes, renames, deletions and syncs of files, and starts of processes.
    """
    calls = folder / "calls"
    calls.write_bytes(bytes(8))
    variables = {**os.environ, "LD_PRELOAD": str(BUILD / "failing.so"), "FAILING_CALLS": str(calls), "FAILING_AT": str(at),
                 "FAILING_BELOW": f"{folder}:{BUILD}"}
    result = subprocess.run([sys.executable, "-P", "-s", "-m", "collektive_experiments", *words], env=variables, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True, timeout=1800)
    count = int.from_bytes(calls.read_bytes(), sys.byteorder)
    require(result.returncode in (0, 1) and "Traceback" not in result.stderr,
            f"exit code {result.returncode} with call {at} of {count} failing: {result.stderr}")
    return result.returncode, count


def check_folders(out: Path) -> None:
    """Checks that each folder is complete, marked as unfinished, empty (after an interrupted deletion or creation), or absent."""
    for folder in [*out.glob("runs/*"), *out.glob("bundle*")]:
        if not os.listdir(folder):
            continue
        if folder.name.endswith(".part"):
            require((folder / MARKER).exists(), f"{folder} must have a marker")
        elif folder.name == "bundle":
            require((folder / "programs.jar").exists() and (folder / "Scenario.dll").exists(), "the bundle must be complete")
        elif not (folder / "run.json").exists():
            require((folder / MARKER).exists(), f"{folder} has no run.json, so it must have a marker")
        else:
            record = json.loads((folder / "run.json").read_text())
            for name, digest in record["files"].items():
                require(hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest, f"{folder / name} differs from its recorded hash")
    for table in out.glob("*.parquet"):
        pd.read_parquet(table)


def try_fault(case: Case, folder: Path, at: int | None = None) -> int:
    """Runs a sweep in which one call fails, resumes it while another call fails, and resumes it again without a failure.

    Returns the number of calls in the first sweep that could have failed.
    """
    path, out = folder / "experiment.json", folder / "out"
    path.write_text(case.text(), encoding="utf-8")
    words = ["sweep", str(path), "--out", str(out), "--jobs", "2", "--keep-going"]
    fails = any(case.settings(values)["fields.fate"] for values in case.runs())
    code, count = run_failing(case.chance.randint(1, 400) if at is None else at, folder, *words)
    for _ in range(2):
        check_folders(out)
        if code == 0:
            check(case, out)
        code, _ = run_failing(case.chance.randint(1, 200), folder, *words, "--resume")
    code, errors = run_command(*words, "--resume")
    require(code == int(fails), f"exit code {code}: {errors}")
    check_folders(out)
    check(case, out)
    return count


def fuzz(seconds: float, seed: int, findings: Path, report: Callable[[str], None] = print) -> int:
    """Tests random experiments for the given number of seconds, and at least one experiment. Returns the number of findings."""
    end, count, found = time.monotonic() + seconds, 0, 0
    while count == 0 or time.monotonic() < end:
        case = Case(random.Random(f"{seed}/{count}"))
        folder = Path(tempfile.mkdtemp(prefix="collektive-fuzz-"))
        try:
            (try_fault if case.chance.random() < 0.3 else try_case)(case, folder)
        except Exception:
            found += 1
            report(f"case {seed}/{count}: {traceback.format_exc()}")
            kept = findings / f"{seed}-{count}"
            shutil.rmtree(kept, ignore_errors=True)
            shutil.copytree(folder, kept, ignore=shutil.ignore_patterns("bundle"))
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        count += 1
    report(f"Done {count} runs in {seconds:.0f} s")
    return found


if __name__ == "__main__":
    sys.exit(min(1, fuzz(float(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))))
