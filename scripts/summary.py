#!/usr/bin/env python3
"""summary.py OUT: prints what a run has written to its folder: how it began and ended, its times, its files."""
import json
import os
import sys


def summary(out: str) -> list[str]:
    with open(os.path.join(out, "manifest.json")) as file:
        ran = json.load(file)
    if ran["outcome"] != "complete":
        return [f"the run is not complete: {ran['outcome']}"]
    lines = [f"{ran['nodes']} nodes, {ran['ticks']} ticks, {ran['shim_calls']} calls into the JVM, seed {ran['scenario']['seed']}, digest {ran['digest']}" +
             ("" if ran["scenario"]["runtime"] == "BuiltIn" else f" (runtime {ran['scenario']['runtime']})")]
    lines += [f"  {name.replace('_', ' ')}: {ran['start'][name]:.2f} -> {ran['end'][name]:.2f}" for name in ran["end"]]
    lines.append(f"  bridge and rounds {ran['step_ms_median']:.2f} ms a tick (median), whole tick {ran['tick_ms_median']:.2f} ms (median), "
                 f"{ran['tick_ms_p99']:.2f} ms (p99)")
    lines.append(f"  {ran['ticks'] / max(ran['wall_seconds'], 1e-9):.0f} ticks/s; {ran['errors']} errors")
    return lines + [os.path.join(out, name) for name in sorted(os.listdir(out))]


if __name__ == "__main__":
    print("\n".join(summary(sys.argv[1])))
