#!/usr/bin/env python3
"""bench_scene.py OUT [--quick] [--nodes N,N...]: the case study at several sizes, each in a process of its own; see ./collektive bench --help."""
import csv
import json
import math
import os
import platform
import re
import subprocess
import sys
import tempfile
from typing import Any

from places import ROOT

SAMPLE = os.path.join(ROOT, "unity/Samples~/GradientAscent")
PHASES = ("sense_ms", "rules_ms", "step_ms", "act_ms", "physics_ms", "other_ms")
NODES = (500, 1000, 2000, 5000, 10000, 20000, 50000)
# Of which so many nodes have the field of the sample as it is.
NODES_OF_FIELD = 500
# Simulated: until then the compilers work, and after that small swarms arrive and crowd.
SECONDS, SETTLED = 10, 6
QUICK_SECONDS, QUICK_SETTLED = 4, 2


def scenario(nodes: int, seconds: int) -> dict[str, Any]:
    """The sample's scenario with so many nodes, as far apart as its 500, and with tables only."""
    with open(os.path.join(SAMPLE, "scenario.json")) as file:
        whole = json.load(file)
    for key in ("scripts", "schema", "programs"):
        whole[key] = os.path.normpath(os.path.join(SAMPLE, whole[key]))
    scale = math.sqrt(nodes / NODES_OF_FIELD)
    whole["fields"] |= {"nodes": nodes, "fieldScale": scale, "source": [25 * scale, 0, 0]}
    return whole | {"seconds": seconds, "outputs": {"metrics": True}}


def run(nodes: int, seconds: int, settled: int) -> dict[str, Any]:
    """The row of one size: the mean tick of the settled seconds, and its phases."""
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "scene.json"), os.path.join(folder, "out")
        what = scenario(nodes, seconds)
        with open(path, "w") as file:
            json.dump(what, file)
        process = subprocess.Popen([os.path.join(ROOT, "collektive"), "run", path, "--out", out], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise SystemExit(f"collektive: bench scene: the run of {nodes} nodes ended with code {process.returncode}; its messages are above")
        with open(os.path.join(out, "metrics.csv")) as file:
            rows = [row for row in csv.DictReader(file) if int(row["second"]) > settled]

    def mean(column: str) -> float:
        return sum(float(row[column]) for row in rows) / len(rows)

    return {"nodes": nodes, "threads": what["threads"], "ticks_per_second": round(1000 / mean("tick_ms"), 2),
            **{phase: round(mean(phase), 3) for phase in PHASES}, "rss_mb": round(usage.ru_maxrss / 1024, 1)}


def micros_per_node(row: dict[str, Any]) -> float:
    return 1e6 / row["ticks_per_second"] / row["nodes"]


def table(rows: list[dict[str, Any]]) -> str:
    """With what a node costs in a tick, and that relative to the first row."""
    columns = ["nodes", "ticks/s", *(phase.removesuffix("_ms") + " ms" for phase in PHASES), "RSS MB", "us a node", "growth"]
    cells = [[f"{row['nodes']}", f"{row['ticks_per_second']:.1f}", *(f"{row[phase]:.2f}" for phase in PHASES), f"{row['rss_mb']:.0f}",
              f"{micros_per_node(row):.2f}", f"{micros_per_node(row) / micros_per_node(rows[0]):.2f}"] for row in rows]
    return "\n".join("".join(text.rjust(11) for text in line) for line in [columns, *cells])


def machine() -> str:
    with open("/proc/cpuinfo") as file:
        model = re.search(r"model name\s*: (.*)", file.read())
    return f"{model.group(1) if model else 'unknown processor'}, {os.cpu_count()} processors; {platform.system()} {platform.release()}"


def main(out: str, *arguments: str) -> None:
    quick, sizes, rest = False, list(NODES), list(arguments)
    while rest:
        option = rest.pop(0)
        if option == "--quick":
            quick = True
        elif option == "--nodes" and rest and re.fullmatch(r"[1-9][0-9]{0,5}(,[1-9][0-9]{0,5})*", rest[0]):
            sizes = [int(size) for size in rest.pop(0).split(",")]
        elif option == "--nodes":
            raise SystemExit("collektive: bench scene: --nodes needs numbers from 1 to 999999, with commas between them")
        else:
            raise SystemExit(f"collektive: bench scene: unknown argument {option} (see ./collektive bench --help)")
    rows = [run(nodes, *((QUICK_SECONDS, QUICK_SETTLED) if quick else (SECONDS, SETTLED))) for nodes in sizes]
    os.makedirs(os.path.dirname(os.path.abspath(out)), exist_ok=True)
    with open(out, "w") as file:
        json.dump({"machine": machine(), "rows": rows}, file, indent=2)
        file.write("\n")
    print(table(rows))


if __name__ == "__main__":
    main(*sys.argv[1:])
