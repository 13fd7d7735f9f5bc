"""Plots metrics of a sweep over time and at the end, as SVG and PDF files and one HTML page."""
import hashlib
import html
import io
import os
import re
from collections.abc import Sequence
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import files
from .experiment import text
from .positions import ExperimentError
from .results import Results, compare, interval, label, load

# The colour-blind-safe palette of Okabe and Ito, without yellow, which is too pale for lines.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
LINES = ("-", "--", "-.", ":")
COLUMNS = 4
STYLE: Any = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.3, "svg.fonttype": "none",
         "svg.hashsalt": "collektive", "legend.frameon": False, "text.parse_math": False}
MAX_PANELS = 24


@matplotlib.rc_context(STYLE)
def plot(folder: str, metrics: Sequence[str] | None = None) -> list[str]:
    """
    Writes `figures/METRIC-time` and `figures/METRIC-end` as SVG and PDF, and `figures.html` with all figures and captions, to the folder of a
    sweep. Colours show the values of the first key that varies, and panels the combinations of the other keys. Returns the paths.
    """
    results = load(folder)
    if results.complete.empty:
        raise ExperimentError(f"'{folder}' has no complete run to plot: the message of each is in runs.parquet")
    paths, sections = [], []
    files.make(os.path.join(folder, "figures"))
    converged = [name for name in results.runs.columns if name.startswith("converged.")]
    for metric in list(metrics or results.metrics) + ([] if metrics else converged):
        figures = {}
        if metric not in converged:
            figures["time"] = over_time(results, metric)
        figures["end"] = at_end(results, metric)
        for kind, (figure, caption) in figures.items():
            name = os.path.join(folder, "figures", f"{_file_name(metric)}-{kind}")
            for ending in (".svg", ".pdf"):
                with files.create(name + ending) as file:
                    figure.savefig(file, format=ending[1:], metadata={"Date": None} if ending == ".svg" else {"CreationDate": None})
                files.publish(name + ending)
                paths.append(name + ending)
            sections.append(f"<figure>{_svg(figure)}<figcaption>{html.escape(caption)}</figcaption></figure>")
        sections.append(_table(results, metric))
    page = os.path.join(folder, "figures.html")
    files.write(page, _page(os.path.basename(os.path.abspath(folder)), results, sections))
    return [*paths, page]


def _file_name(metric: str) -> str:
    """Returns a file name for a metric. Adds a hash if the metric's name has characters that file names cannot have."""
    name = re.sub(r"[^A-Za-z0-9_.-]", "_", metric)[:100]
    return name if name == metric and not name.startswith(".") else f"metric-{name}-{hashlib.sha256(metric.encode()).hexdigest()[:8]}"


@matplotlib.rc_context(STYLE)
def over_time(results: Results, metric: str) -> tuple[Figure, str]:
    """Plots the mean of a metric over simulated time with its 95 % bootstrap interval. Returns the figure and its caption."""
    data = results.series
    figure, panels, colour, groups = _panels(results, data)
    counts = set()
    for axes, group in zip(panels, groups):
        for index, (value, runs) in enumerate(_split(group, colour)):
            table = runs.pivot_table(index="run", columns="second", values=metric)
            counts.add(len(table))
            if table.empty:
                continue
            bounds = np.array([interval(table[second].dropna().to_numpy()) for second in table.columns])
            shade = COLOURS[index % len(COLOURS)]
            axes.plot(table.columns, table.mean(), label=value, color=shade, linestyle=LINES[index // len(COLOURS) % len(LINES)])
            axes.fill_between(table.columns, bounds[:, 0], bounds[:, 1], color=shade, alpha=0.2, linewidth=0)
        axes.set_xlabel("simulated time [s]")
    _finish(figure, panels, _axis(results, metric), colour, lines=True)
    return figure, f"{_title(metric)} over simulated time: mean and 95 % bootstrap interval of {_runs(counts)} per configuration."


@matplotlib.rc_context(STYLE)
def at_end(results: Results, metric: str) -> tuple[Figure, str]:
    """Draws box plots of a metric's values at the end of the runs. Returns the figure and its caption."""
    figure, panels, colour, groups = _panels(results, results.complete)
    counts, missing = set(), 0
    for axes, group in zip(panels, groups):
        parts = list(_split(group, colour))
        for index, (_, runs) in enumerate(parts):
            values = runs[metric].dropna().to_numpy(float)
            counts.add(len(runs))
            missing += len(runs) - len(values)
            box = axes.boxplot([values], positions=[index], widths=0.6, patch_artist=True, medianprops={"color": "black"}, flierprops={"markersize": 3})
            box["boxes"][0].set(facecolor=COLOURS[index % len(COLOURS)], alpha=0.6)
        axes.set_xticks(range(len(parts)), [value for value, _ in parts], rotation=30, ha="right")
        axes.set_xlim(-0.6, len(parts) - 0.4)
    _finish(figure, panels, _axis(results, metric), colour, lines=False)
    rest = f" {missing} runs without a value are omitted." if missing else ""
    when = "" if metric.startswith("converged.") else " at the end"
    return figure, (f"{_title(metric)}{when} of {_runs(counts)} per configuration: median, quartiles, whiskers to the last value within 1.5 "
                    f"interquartile ranges, and values beyond.{rest}")


def _panels(results: Results, data: pd.DataFrame) -> tuple[Figure, list[Axes], str | None, list[pd.DataFrame]]:
    keys = results.configuration
    colour, others = (keys[0], keys[1:]) if keys else (None, [])
    parts = list(data.groupby(others, sort=False)) if others else [((), data)]
    parts = parts[:MAX_PANELS]
    columns = min(COLUMNS, len(parts))
    rows = -(-len(parts) // columns)
    figure = Figure(figsize=(max(3.4, 2.3 * columns) + 0.6, 2.3 * rows + 0.7), layout="constrained")
    grid = figure.subplots(rows, columns, sharey=True, sharex=True, squeeze=False).flatten()
    for axes in grid[len(parts):]:
        axes.set_visible(False)
    for axes, (values, _) in zip(grid, parts):
        axes.set_title(label(values, others), fontsize=9)
    return figure, list(grid[:len(parts)]), colour, [group for _, group in parts]


def _split(group: pd.DataFrame, colour: str | None) -> list[tuple[str, pd.DataFrame]]:
    if colour is None:
        return [("all runs", group)]
    return [(text(value.item() if hasattr(value, "item") else value), part) for value, part in group.groupby(colour, sort=False)]


def _finish(figure: Figure, panels: list[Axes], axis: str, colour: str | None, lines: bool) -> None:
    for index, axes in enumerate(panels):
        if index % COLUMNS == 0:
            axes.set_ylabel(axis)
    if lines and colour:
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, title=colour, loc="outside upper center", ncols=len(labels))


def _axis(results: Results, metric: str) -> str:
    unit = "s" if metric.startswith("converged.") else results.units.get(metric, "")
    return _title(metric) + (f" [{unit}]" if unit else "")


def _title(metric: str) -> str:
    if metric.startswith("converged."):
        return f"time to convergence of {_title(metric.removeprefix('converged.'))}"
    return re.sub(r"[\x00-\x1f\x7f_]", " ", metric)


def _runs(counts: set[int]) -> str:
    low, high = min(counts, default=0), max(counts, default=0)
    return f"{high} run" + ("s" if high != 1 else "") if low == high else f"{low} to {high} runs"


def _svg(figure: Figure) -> str:
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    return buffer.getvalue().split("?>", 1)[1].split(".dtd\">", 1)[-1]


def _table(results: Results, metric: str) -> str:
    if not results.configuration:
        return ""
    effects = compare(results, metric, results.configuration[0])
    if effects.empty:
        return ""
    table = effects.to_html(index=False, float_format=lambda number: f"{number:.3g}", border=0)
    return f"<details><summary>{html.escape(_title(metric))}: effect sizes</summary>{table}</details>"


def _page(title: str, results: Results, sections: list[str]) -> str:
    status = results.runs["status"].value_counts()
    counts = ", ".join(f"{count} {name}" for name, count in status.items())
    style = ("body{font:15px system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}figure{margin:2em 0}svg{max-width:100%;height:auto}"
             "table{border-collapse:collapse;font-size:13px}td,th{padding:2px 8px;text-align:right}")
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    return (f"<!doctype html><html lang=en><meta charset=utf-8><meta http-equiv=Content-Security-Policy content=\"{policy}\">"
            f"<title>{html.escape(title)}</title><style>{style}</style><h1>{html.escape(title)}</h1>"
            f"<p>Runs: {html.escape(counts)}.</p>{''.join(sections)}</html>\n")
