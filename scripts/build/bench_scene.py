"""Benchmarks whole ticks of the case study at several sizes, each in its own process."""
import csv
import json
import math
import os
import platform
import re
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from build import graph, inputs, lock, projects
from build.console import Failure
from build.places import BUILD, COLLEKTIVE, ROOT

SAMPLE = ROOT / "unity/Samples~/GradientAscent"
CASE_STUDY = BUILD / "bench/case_study"
PHASES = ("queries_ms", "rules_ms", "sense_ms", "step_ms", "act_ms", "physics_ms", "other_ms")
# The phases with the same work as a bare loop in C.
BARE_PHASES = {"sense_ms": ("queries_ms", "sense_ms"), "rules_ms": ("rules_ms",), "rounds_ms": ("step_ms",), "act_ms": ("act_ms",),
               "physics_ms": ("physics_ms",)}
NODES = (500, 1000, 2000, 5000, 10000, 20000, 50000)
# The number of nodes in the sample. The field is scaled for other numbers.
NODES_OF_FIELD = 500
# Times are means over the simulated seconds 6 to 10: the JIT compilers have mostly warmed up, and small swarms do not crowd at the source yet.
INTERVAL, SETTLED, MEASURED = 2, 6, 10
QUICK_INTERVAL, QUICK_SETTLED, QUICK_MEASURED = 1, 2, 4
# The p99 is the slowest tick of 120: three intervals that begin at least 5 seconds of the clock after the start.
P99_INTERVALS, WARM_UP_MS = 3, 5000


def seconds_of(nodes: int) -> int:
    """Returns the simulated seconds of a run that lasts longer than the warm-up, as a multiple of the interval."""
    return max(MEASURED, INTERVAL * math.ceil(30 * math.sqrt(NODES_OF_FIELD / nodes)))


def scenario(nodes: int, seconds: int, interval: int) -> dict[str, Any]:
    """Returns the sample's scenario for a number of nodes, with the same density and with tables as the only output."""
    whole: dict[str, Any] = json.loads((SAMPLE / "scenario.json").read_text())
    for key in ("scripts", "schema", "programs"):
        whole[key] = os.path.normpath(os.path.join(SAMPLE, whole[key]))
    scale = math.sqrt(nodes / NODES_OF_FIELD)
    whole["fields"] |= {"nodes": nodes, "fieldScale": scale, "source": [25 * scale, 0, 0]}
    return whole | {"seconds": seconds, "outputs": {"metrics": True, "interval": interval}}


def slowest(rows: list[dict[str, str]], ticks: int) -> tuple[float, float]:
    """Returns the slowest of 120 ticks after the warm-up in milliseconds, and its ratio to their mean.

    If the warm part of a run contains several such groups of ticks, these are the values of the group with the median ratio. If it contains none, they are
    the values of the whole run. `ticks` is the number of ticks in a row.
    """
    begin, warm = 0.0, []
    for row in rows:
        if begin >= WARM_UP_MS:
            warm.append(row)
        begin += ticks * float(row["tick_ms"])
    groups = [warm[at:at + P99_INTERVALS] for at in range(0, len(warm) - P99_INTERVALS + 1, P99_INTERVALS)] or [rows]
    maxima = [max(float(row["tick_ms_p99"]) for row in group) for group in groups]
    results = sorted((tick / mean(group, "tick_ms"), tick) for tick, group in zip(maxima, groups))
    ratio, tick = results[len(results) // 2]
    return tick, ratio


def mean(rows: list[dict[str, str]], column: str) -> float:
    return sum(float(row[column]) for row in rows) / len(rows)


def run(nodes: int, seconds: int, interval: int, settled: int, measured: int) -> dict[str, Any]:
    """Measures one size.

    Returns the mean times of ticks and their phases, the 99th percentile after the warm-up and its ratio to the mean, and the times of the same ticks as
    bare loops in C.
    """
    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder, "scene.json"), Path(folder, "out")
        settings = scenario(nodes, seconds, interval)
        path.write_text(json.dumps(settings))
        process = subprocess.Popen([COLLEKTIVE, "run", path, "--out", out], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise Failure(f"bench scene: the run of {nodes} nodes ended with code {process.returncode}; its messages are above")
        with (out / "metrics.csv").open() as file:
            # The first row is of the first tick.
            rows = list(csv.DictReader(file))[1:]

    ticks = [str(round(second / settings["deltaTime"])) for second in (measured, settled)]
    bare = subprocess.run([CASE_STUDY, str(nodes), str(settings["threads"]), *ticks], check=True, stdout=subprocess.PIPE, text=True)
    p99, ratio = slowest(rows, round(interval / settings["deltaTime"]))
    rows = [row for row in rows if settled < int(row["second"]) <= measured]
    return {"nodes": nodes, "threads": settings["threads"], "ticks_per_second": round(1000 / mean(rows, "tick_ms"), 2),
            "tick_ms_p99": round(p99, 3), "p99_to_mean": round(ratio, 3),
            **{phase: round(mean(rows, phase), 3) for phase in PHASES}, "rss_mb": round(usage.ru_maxrss / 1024, 1),
            "mean_distance": float(rows[-1]["mean_distance"]), "in_c": json.loads(bare.stdout)}


def micros_per_node(row: dict[str, Any]) -> float:
    return float(1e6 / row["ticks_per_second"] / row["nodes"])


def table(rows: list[dict[str, Any]]) -> str:
    """Formats the rows as two tables.

    The first contains the phases, and the time per node and tick in microseconds, also relative to the first row. The second contains the phases and the
    whole tick, the same work as bare loops in C, and the ratio.
    """
    columns = ["nodes", "ticks/s", "p99 ms", "p99/mean", *(phase.removesuffix("_ms") + " ms" for phase in PHASES), "RSS MB", "us a node", "growth"]
    cells = [[f"{row['nodes']}", f"{row['ticks_per_second']:.1f}", f"{row['tick_ms_p99']:.2f}",
              f"{row['p99_to_mean']:.2f}", *(f"{row[phase]:.2f}" for phase in PHASES), f"{row['rss_mb']:.0f}",
              f"{micros_per_node(row):.2f}", f"{micros_per_node(row) / micros_per_node(rows[0]):.2f}"] for row in rows]
    bare_columns = ["ms : in C", *(phase.removesuffix("_ms") for phase in BARE_PHASES), "tick"]
    bare_cells = [[f"{row['nodes']}", *(_ratio(sum(row[phase] for phase in phases), row["in_c"][bare]) for bare, phases in BARE_PHASES.items()),
                   _ratio(1000 / row["ticks_per_second"], sum(row["in_c"][bare] for bare in BARE_PHASES))] for row in rows]
    return "\n".join(["".join(text.rjust(12) for text in line) for line in [columns, *cells]] + [""]
                     + ["".join(text.rjust(25) for text in line) for line in [bare_columns, *bare_cells]])


def _ratio(ms: float, bare_ms: float) -> str:
    return f"{ms:.2f} : {bare_ms:.2f} = {f'{ms / bare_ms:.2f}' if bare_ms > 0 else '-'}"


def machine() -> str:
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    return f"{model[1] if model else 'unknown processor'}, {os.cpu_count()} processors; {platform.system()} {platform.release()}"


def sizes_of(text: str) -> list[int]:
    """Parses the numbers of nodes in an option."""
    if not re.fullmatch(r"[1-9][0-9]{0,5}(,[1-9][0-9]{0,5})*", text):
        raise Failure("bench scene: --nodes needs numbers from 1 to 999999, with commas between them")
    return [int(size) for size in text.split(",")]


def measure(out: Path, quick: bool, sizes: Sequence[int]) -> None:
    """Runs all sizes, writes their rows to a file, and prints the table."""
    graph.build("runtime", "case_study")
    # Compile before the runs, because the memory of a run includes the memory of processes that it starts.
    projects.scripts_dll(inputs.schema(SAMPLE / "gradient_ascent.fbs"), inputs.scripts(SAMPLE))
    lock.release()
    rows = [run(nodes, QUICK_MEASURED, QUICK_INTERVAL, QUICK_SETTLED, QUICK_MEASURED) if quick
            else run(nodes, seconds_of(nodes), INTERVAL, SETTLED, MEASURED) for nodes in sizes]
    out.write_text(json.dumps({"machine": machine(), "rows": rows}, indent=2) + "\n")
    print(table(rows), flush=True)
