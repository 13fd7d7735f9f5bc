"""Plots the metrics of a sweep as SVG and PDF files and on one HTML page."""
import hashlib
import html
import io
import os
import re
import sys
import textwrap
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatter, NullFormatter, PercentFormatter

from . import files
from .experiment import Experiment, check_labels, read_figures, text
from .figure_options import CENSORED, CONVERGED, TIME, Fail, FigureOptions, check_keys, check_metrics
from .positions import ExperimentError, Located
from .results import VALUE, Results, compare, load, name_of_metric, require_distinct
from .statistics import interval, kaplan_meier
from .store import Store

# The palette of Okabe and Ito, which is safe for colour-blind readers. It lacks yellow, which is too pale for lines.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
LINES = ("-", "--", "-.", ":")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*", "<", ">")
HATCHES = ("", "////", "....", "xxxx", "\\\\\\\\", "++++", "oooo", "----", "||||", "****")
COLUMNS = 4
# PDF files contain TrueType fonts, because publishers refuse Matplotlib's default, Type 3.
STYLE: Any = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.3, "svg.fonttype": "none",
         "svg.hashsalt": "collektive", "legend.frameon": False, "text.parse_math": False, "pdf.fonttype": 42, "axes.axisbelow": True}
SMALL: Any = {"font.size": 8, "axes.labelsize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "legend.title_fontsize": 7,
              "lines.linewidth": 1.2, "lines.markersize": 4, "axes.linewidth": 0.6, "grid.linewidth": 0.4, "hatch.linewidth": 0.5,
              "legend.handlelength": 2.6, "legend.columnspacing": 1.2, "legend.borderaxespad": 0.2, "figure.constrained_layout.w_pad": 0.02,
              "figure.constrained_layout.h_pad": 0.02}
# STIX resembles the text fonts of both publishers. Both fonts are part of Matplotlib, so figures are equal on all machines.
PAPER: Any = {**SMALL, "font.family": ["STIXGeneral", "DejaVu Sans"], "svg.fonttype": "path"}
STYLES: Any = {
    "plain": SMALL,
    "ieee": {**PAPER, "axes.spines.top": True, "axes.spines.right": True, "xtick.direction": "in", "ytick.direction": "in"},
    "acm": PAPER,
}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MAX_PANELS = 24
MAX_LINES = 24
"""The maximum number of lines in a figure over time, and of values in a table of effect sizes. More lines would need a legend larger than the figure."""
MAX_POINTS = 20
"""The maximum number of runs for which a box plot shows a point for each run."""
BOUND = "bound\0"
"""The name of a column that marks censored runs. No metric can have this name."""
GOLDEN_RATIO = 0.618034
"""The multiplier that spreads the points of a box plot sideways."""
TOLERANCE, MIN_AXES = 0.02, 0.5
"""The inches by which labels may extend beyond a figure, and the minimum width and height of its axes in inches."""
LINE_LENGTH, TITLE_LENGTH = 24, 32
"""The characters per line of long labels of vertical axes, and of panel titles."""
MAX_VALUE = 1e300
"""The largest value that figures can show. With larger ones, Matplotlib's calculations overflow."""
MAX_CELLS = 64
"""The maximum number of cells for which a heat map contains numbers."""


class PowerFormatter(LogFormatter):
    """Labels a logarithmic axis without Matplotlib's math text, which is disabled because names of metrics may contain its markup."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        """Returns the label of a tick. Some minor ticks have an empty label."""
        if not super().__call__(x, pos):
            return ""
        if 1e-3 <= x < 1e4:
            return f"{x:.12g}"
        # Ticks between two powers need several digits if the axis contains no power.
        factor, exponent = f"{x:.11e}".split("e")
        factor = factor.rstrip("0").rstrip(".")
        return (f"{factor}·" if factor != "1" else "") + "10" + str(int(exponent)).translate(SUPERSCRIPTS)


@dataclass(frozen=True)
class Drawing:
    """A rendered figure."""
    caption: str
    svg: bytes
    pdf: bytes

    def write(self, path: str) -> Iterator[str]:
        """Writes the SVG file, the PDF file and the caption. Yields their paths."""
        for ending, content in ((".svg", self.svg), (".pdf", self.pdf), (".txt", self.caption.encode() + b"\n")):
            with files.create(path + ending) as file:
                file.write(content)
            files.publish(path + ending)
            yield path + ending

    def markup(self) -> str:
        """Returns the SVG element without the XML header."""
        return self.svg.decode().split("?>", 1)[1].split(".dtd\">", 1)[-1]


@matplotlib.rc_context()
def plot(folder: str, metrics: Sequence[str] | None = None, options: FigureOptions | None = None, experiment: Experiment | None = None) -> list[str]:
    """
    Writes figures of a sweep as SVG and PDF, and their captions as text, to `figures/` in the sweep's folder. Returns their paths.

    With `options`, writes only the requested figures. Otherwise writes these files:
    - `METRIC-time` and `METRIC-end` for each metric, with a colour for each value of the first key that varies, and panels for the other keys;
    - the figures of the experiment file;
    - `figures.html` with all figures and captions.

    The figures and labels of `experiment` replace those that the experiment file had during the sweep.
    """
    # A file matplotlibrc must not change figures, or run LaTeX on their labels.
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)
    results = load(folder, experiment.labels if experiment else None)
    if results.complete.empty:
        raise ExperimentError(f"'{folder}' has no complete runs to plot; their errors are in runs.parquet. Correct them and continue with --resume")
    if later := Store(folder).count_complete_except({*results.complete["run"]}):
        print(f"collektive: complete runs that the figures omit because they are not in the tables: {later}; the sweep has not ended, or their values were "
              "removed from the experiment file", file=sys.stderr)
    requests = [options] if options else _requests(folder, experiment)
    for request in requests:
        check(results, request)
    known = metrics_at_end(results)
    if experiment:
        check_labels(experiment, list(dict.fromkeys([*known, *map(name_of_metric, results.metrics)])))
    shown = [] if options else list(map(results.column, metrics) if metrics else [*results.metrics, *results.convergence_times])
    for metric in [name for name in results.metrics if name in shown]:
        if max(values.abs().max() for values in (results.series[metric], results.complete[metric])) > MAX_VALUE:
            print(f"collektive: the metric '{metric}' is not drawn: it has values beyond {MAX_VALUE:g}, the limit of figures", file=sys.stderr)
            shown.remove(metric)
    # Names that differ only in case are the same file on some systems.
    reserved = {f"{file_name(metric, known)}-{kind}".lower() for metric in shown for kind in ("time", "end")}
    drawn: dict[str, Drawing] = {}
    tables: dict[str, str] = {}
    for request in requests:
        for name, figure, caption in draw(results, request):
            if name.lower() in {*map(str.lower, drawn), *reserved}:
                raise request.fail("metric", f"and the other options describe an existing figure: '{name}'; remove one")
            drawn[name] = _render(figure, caption, STYLES[request.style], request.fail)
    for metric in shown:
        if metric in results.metrics:
            drawn[f"{file_name(metric, known)}-time"] = _render(*over_time(results, metric), {})
        last = f"{file_name(metric, known)}-end"
        drawn[last] = _render(*at_end(results, metric), {})
        tables[last] = _table(results, metric)
    files.make(os.path.join(folder, "figures"))
    paths = [path for name, drawing in drawn.items() for path in drawing.write(os.path.join(folder, "figures", name))]
    if not options:
        sections = [f"<figure>{drawing.markup()}<figcaption>{html.escape(drawing.caption)}</figcaption></figure>{tables.get(name, '')}"
                    for name, drawing in drawn.items()]
        paths.append(os.path.join(folder, "figures.html"))
        files.write(paths[-1], _page(os.path.basename(os.path.abspath(folder)), results, sections))
    _warn_of_earlier_figures(Path(folder))
    return paths


def _warn_of_earlier_figures(folder: Path) -> None:
    """Prints the names of figures that were drawn before the tables were written."""
    written = (folder / "runs.parquet").stat().st_mtime
    drawn = [*folder.glob("figures.html"), *sorted(folder.glob("figures/*.pdf"))]
    if older := [str(path.relative_to(folder)) for path in drawn if path.stat().st_mtime < written]:
        print(f"collektive: in '{folder}', these figures are older than the tables: {', '.join(older)}; draw them again, or delete them", file=sys.stderr)


def _requests(folder: str, experiment: Experiment | None) -> list[FigureOptions]:
    """Returns the figures of the experiment file."""
    if experiment:
        return experiment.figures
    return read_figures(Located(os.path.join(folder, "sweep.json")))


def _render(figure: Figure, caption: str, style: Any, fail: Fail | None = None) -> Drawing:
    """Renders a figure. The style must be the one in which it was drawn, because Matplotlib creates ticks and fonts during rendering."""
    with matplotlib.rc_context(style), warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        svg, pdf = _save(figure)
        if not _fits(figure):
            found.clear()
            for axes in figure.axes:
                axes.set_ylabel(textwrap.fill(axes.get_ylabel(), LINE_LENGTH, break_long_words=False))
            svg, pdf = _save(figure)
        if not fail and not _fits(figure):
            # Figures without a requested size grow around labels that are too long for them.
            found.clear()
            svg, pdf = _save(figure, "tight")
        if fail and not _fits(figure):
            raise fail("size", f"leaves too little space for labels: {figure.get_figwidth():g}x{figure.get_figheight():g}; enlarge it, or set shorter labels")
    for message in dict.fromkeys(str(warning.message) for warning in found):
        print(f"collektive: {message}", file=sys.stderr)
    # XML cannot contain these characters of values, even in an escaped form.
    return Drawing(caption, re.sub("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", "\ufffd", svg.decode()).encode(), pdf)


def _save(figure: Figure, box: str | None = None) -> tuple[bytes, bytes]:
    """Returns the figure as SVG and PDF."""
    svg, pdf = io.BytesIO(), io.BytesIO()
    figure.savefig(svg, format="svg", metadata={"Date": None}, bbox_inches=box)
    figure.savefig(pdf, format="pdf", metadata={"CreationDate": None}, bbox_inches=box)
    return svg.getvalue(), pdf.getvalue()


def _fits(figure: Figure) -> bool:
    """Returns whether all labels are inside the figure, and the axes have a readable size."""
    drawn, axes = figure.get_tightbbox(), figure.axes[0].get_position()
    width, height = figure.get_size_inches()
    is_inside = min(drawn.x0, drawn.y0) > -TOLERANCE and drawn.x1 < width + TOLERANCE and drawn.y1 < height + TOLERANCE
    return bool(is_inside and min(axes.width * width, axes.height * height) > MIN_AXES)


def file_name(metric: str, metrics: Sequence[str]) -> str:
    """Returns a file name for one of the metrics.

    Adds a hash if the metric's name contains characters that file names cannot contain, or differs from an earlier name only in case.
    """
    name = re.sub(r"[^A-Za-z0-9_.,=-]", "_", metric)[:100]
    first = next(other for other in metrics if other.lower() == metric.lower())
    return name if name == metric == first and not name.startswith(".") else f"metric-{name}-{hashlib.sha256(metric.encode()).hexdigest()[:8]}"


def check(results: Results, options: FigureOptions) -> None:
    """Checks that the sweep has the keys, metrics and values that a requested figure needs."""
    options = _with_columns(results, options)
    check_keys(options, {key: [value.item() if hasattr(value, "item") else value for value in results.runs[key].dropna().unique()]
                         for key in results.keys})
    check_metrics(options, metrics_at_end(results), results.metrics)
    series = results.selected_series if options.x == TIME else None
    for metric in options.metrics:
        values = results.values(metric) if series is None else series[metric]
        if values.isna().all():
            raise options.fail("metric", f"is '{metric}', which has no value in any run")
        if values.abs().max() > MAX_VALUE:
            raise options.fail("metric", f"is '{metric}', which has values beyond {MAX_VALUE:g}, the limit of figures")
        if ("x" if options.kind == "ecdf" else "y") in options.log and values.min() <= 0:
            raise options.fail("log", f"is '{options.log}', but '{metric}' has the value {values.min():g}, and a logarithmic axis needs values above 0")


def metrics_at_end(results: Results) -> list[str]:
    """Returns the columns with a number for the end of each run, beginning with the metrics."""
    known = results.metrics + results.convergence_times
    others = {*known, *results.keys, "seed", *(CENSORED + name.removeprefix(CONVERGED) for name in results.convergence_times)}
    return known + [name for name in results.runs.select_dtypes("number").columns if name not in others]


def draw(results: Results, options: FigureOptions) -> Iterator[tuple[str, Figure, str]]:
    """Draws the requested figure for each metric and each combination of values of the keys that it does not show. Yields name, figure and caption."""
    check(results, options)
    options = _with_columns(results, options)
    data = results.selected_series if options.x == TIME else results.complete
    require_distinct(data, results.configuration)
    others = [key for key in results.other_keys([key for key in (options.x, options.by) if key and key != TIME]) if results.runs[key].nunique() > 1]
    combinations = list(data.groupby(others, sort=False)) if others else [((), data)]
    if len(combinations) > MAX_PANELS:
        raise options.fail("by", f"leaves {len(combinations)} combinations of {', '.join(others)}, each with its own figure; the maximum is {MAX_PANELS}")
    endings = ["-".join(["", options.kind, *filter(None, [options.x, options.by]),
                         *(f"{key}={text(value.item() if hasattr(value, 'item') else value)}" for key, value in zip(others, values))])
               for values, _ in combinations]
    names = [metric + ending for metric in metrics_at_end(results) for ending in endings]
    for metric in options.metrics:
        for (values, part), ending in zip(combinations, endings):
            with matplotlib.rc_context(STYLE), matplotlib.rc_context(STYLES[options.style]):
                figure = Figure(figsize=options.size, layout="constrained")
                caption = _draw(figure, results, part, metric, options) + _omitted(results, others, values)
            yield file_name(metric + ending, names), figure, caption + (f" {_title(results, values, others)}." if others else "")


def _with_columns(results: Results, options: FigureOptions) -> FigureOptions:
    return replace(options, metrics=tuple(map(results.column, options.metrics)))


def _draw(figure: Figure, results: Results, data: pd.DataFrame, metric: str, options: FigureOptions) -> str:
    """Draws a figure with one pair of axes. Returns its caption."""
    axes = figure.add_subplot()
    if options.kind == "heat":
        counts = _heat(figure, axes, results, data, metric, options)
        return _caption(results, data, metric, "heat", options.x, counts)
    if options.kind == "ecdf":
        counts = _distribution(axes, results, data, metric, options.by)
    elif options.kind == "box":
        counts = _boxes(axes, results, data, metric, options.x, options.by)
    elif options.x == TIME:
        counts = _line_over_time(axes, results, data, metric, options.by)
    else:
        counts = _line(axes, results, data, metric, str(options.x), options.by)
    if options.kind == "ecdf":
        axes.set(xlabel=_axis(results, metric), ylabel="converged runs" if metric.startswith(CONVERGED) else "runs", ylim=(-0.02, 1.02))
        axes.yaxis.set_major_formatter(PercentFormatter(1, 0))
    else:
        axes.set(xlabel="simulated time [s]" if options.x == TIME else _axis(results, str(options.x)), ylabel=_axis(results, metric))
    for name, set_scale, axis in (("x", axes.set_xscale, axes.xaxis), ("y", axes.set_yscale, axes.yaxis)):
        if name in options.log:
            set_scale("log")
            axis.set_major_formatter(PowerFormatter())
            axis.set_minor_formatter(PowerFormatter())
    if options.kind == "line" and options.x != TIME and "x" in options.log:
        ticks = _order(data[options.x])
        axes.set_xticks(ticks, [_value(results, tick) for tick in ticks])
        axes.xaxis.set_minor_formatter(NullFormatter())
    (axes.set_xlim if options.kind == "ecdf" else axes.set_ylim)(*options.range)
    if (axes.xaxis if options.kind == "ecdf" else axes.yaxis).get_inverted():
        raise _no_value(options, metric)
    if options.by:
        _add_legend(figure, results, options.by)
    return _caption(results, data, metric, options.kind, options.x, counts)


def _no_value(options: FigureOptions, metric: str) -> ExperimentError:
    """Returns the error for a range with one limit that leaves no value, for which Matplotlib would invert the axis."""
    return options.fail("range", f"contains no value of '{metric}' in at least one figure; set both limits")


def _add_legend(figure: Figure, results: Results, by: str) -> None:
    """Adds a legend above the axes, with as many columns as fit."""
    # Artists are labelled with the indices of values, because Matplotlib omits empty labels and labels that start with an underscore.
    known = {index: handle for axes in figure.axes for handle, index in zip(*axes.get_legend_handles_labels())}
    shown = {index: name for index, name in enumerate(_names(results, by)) if str(index) in known}
    labels, handles = list(shown.values()), [known[str(index)] for index in shown]
    # Numbers need a title that explains them, and names do not.
    title = None if pd.api.types.is_string_dtype(results.runs[by]) else _axis(results, by)
    # Warnings about missing glyphs are printed when the figure is rendered.
    with warnings.catch_warnings(action="ignore"):
        for columns in range(len(labels), 0, -1):
            legend = figure.legend(handles, labels, title=title, loc="outside upper center", ncols=columns)
            if columns == 1 or legend.get_window_extent().width <= figure.bbox.width:
                return
            legend.remove()


def _line_over_time(axes: Axes, results: Results, data: pd.DataFrame, metric: str, by: str | None) -> set[int]:
    counts = set()
    parts = _split(results, data, by)
    for index, runs in parts:
        # Times at which no run has a value interrupt the line.
        table = runs.pivot(index=["run", "seed"], columns="second", values=metric)
        # Runs that end earlier have no values at later times, so the number of runs differs between times.
        counts.update(count for count in table.notna().sum() if count)
        if table.isna().all(axis=None):
            continue
        bounds = np.array([interval(table[second].dropna().to_numpy()) for second in table.columns])
        line_style = _line_style(index)
        # Lines have their markers at different times, so that markers do not cover each other. Values without neighbours are visible only as markers.
        step = max(1, len(table.columns) // 6)
        means = table.mean()
        is_isolated = (means.notna() & means.shift().isna() & means.shift(-1).isna()).to_numpy()
        marked = {*range(index * step // (parts[-1][0] + 1), len(means), step), *np.flatnonzero(is_isolated)}
        axes.plot(table.columns, means, label=str(index), markevery=sorted(marked), **line_style)
        axes.vlines(table.columns[is_isolated], *bounds[is_isolated].T, color=line_style["color"], alpha=0.2)
        axes.fill_between(table.columns, bounds[:, 0], bounds[:, 1], color=line_style["color"], alpha=0.2, linewidth=0)
    return counts


def _line(axes: Axes, results: Results, data: pd.DataFrame, metric: str, x: str, by: str | None) -> set[int]:
    counts = set()
    values, censored = results.values(metric), results.censored(metric)
    for index, runs in _split(results, data, by):
        rows = []
        for place, part in runs.groupby(x):
            found = values[part.index].dropna().to_numpy(float)
            counts.add(len(found))
            if len(found):
                rows.append((place, found.mean(), *interval(found), censored[part.index].any()))
        if not rows:
            continue
        places, means, low, high, is_bound = (np.array(column) for column in zip(*rows))
        line_style = _line_style(index)
        axes.errorbar(places, means, [np.fmax(means - low, 0), np.fmax(high - means, 0)], label=str(index), capsize=2, **line_style)
        axes.plot(places[is_bound], means[is_bound], linestyle="", marker=line_style["marker"], color=line_style["color"], markerfacecolor="white", zorder=3)
    return counts


def _boxes(axes: Axes, results: Results, data: pd.DataFrame, metric: str, x: str | None, by: str | None) -> set[int]:
    counts: set[int] = set()
    labelled: set[int] = set()
    values, censored = results.values(metric), results.censored(metric)
    # Every value has a place, even if its runs failed, because panels share their axes.
    labels = _names(results, x) if x else ["all runs"]
    boxes = 1 if by is None else results.runs[by].nunique()
    width = 0.8 / boxes
    for place, group in _split(results, data, x):
        for index, part in _split(results, group, by):
            # The values are sorted, so that points of similar values are spread to different positions.
            sample = values[part.index].dropna().sort_values(kind="stable")
            counts.add(len(sample))
            colour = COLOURS[(index if by else place) % len(COLOURS)]
            at = place + (index - (boxes - 1) / 2) * width
            is_few = len(sample) <= MAX_POINTS
            lines = {"color": colour}
            box = axes.boxplot([sample.to_numpy(float)], positions=[at], widths=0.8 * width, patch_artist=True, showfliers=not is_few, whiskerprops=lines,
                               capprops=lines, medianprops={"color": "black"}, flierprops={"markersize": 3}, manage_ticks=False)
            box["boxes"][0].set(facecolor=to_rgba(colour, 0.35), edgecolor=colour, hatch=HATCHES[index] if by else "",
                                label="" if index in labelled else str(index))
            labelled.add(index)
            ended = censored[sample.index].to_numpy(bool)
            if is_few:
                spots = at + 0.5 * width * ((np.arange(len(sample)) * GOLDEN_RATIO) % 1 - 0.5)
                axes.plot(spots[~ended], sample[~ended], "o", color="black", markersize=2.2, markeredgewidth=0, alpha=0.7, zorder=3)
                places, bounds = spots[ended], sample[ended]
            else:
                bounds = sample[ended].drop_duplicates()
                places = np.full(len(bounds), at)
            axes.plot(places, bounds, "^", color=colour, markersize=4, markeredgewidth=0.6, markerfacecolor="white", zorder=3)
    _set_x_labels(axes, labels)
    axes.set_xlim(-0.6, len(labels) - 0.4)
    axes.grid(False, axis="x")
    return counts


def _set_x_labels(axes: Axes, labels: list[str]) -> None:
    """Labels the positions 0, 1, ... of the horizontal axis. Long labels are rotated, so that they do not overlap."""
    axes.set_xticks(range(len(labels)), labels)
    if sum(map(len, labels)) > 30:
        axes.tick_params("x", rotation=30)
        for tick in axes.get_xticklabels():
            tick.set_horizontalalignment("right")


def _distribution(axes: Axes, results: Results, data: pd.DataFrame, metric: str, by: str | None) -> set[int]:
    counts = set()
    values, censored = results.values(metric), results.censored(metric)
    low_end, end = values[data.index].min(), values[data.index].max()
    start = 0 if metric.startswith(CONVERGED) else low_end - 0.03 * (end - low_end)
    for index, runs in _split(results, data, by):
        sample = values[runs.index].dropna()
        is_censored = censored[sample.index].to_numpy(bool)
        counts.add(len(sample))
        if sample.empty:
            continue
        times, *curves = kaplan_meier(sample.to_numpy(float), ~is_censored)
        # A Kaplan-Meier estimate is unknown after its last run if this run is censored.
        places = np.array([start, *times, sample.max() if is_censored[sample == sample.max()].any() else end])
        shares, low, high = (np.array([0, *curve, curve[-1] if len(curve) else 0]) for curve in curves)
        line_style = _line_style(index)
        axes.step(places, shares, where="post", label=str(index), markevery=[*range(1, len(places) - 1, max(1, len(places) // 5))], **line_style)
        axes.fill_between(places, low, high, step="post", color=line_style["color"], alpha=0.15, linewidth=0)
        ends = np.unique(sample[is_censored])
        axes.plot(ends, shares[np.searchsorted(places, ends, side="right") - 1], linestyle="", marker="|", markersize=8, color=line_style["color"], zorder=3)
    return counts


def _heat(figure: Figure, axes: Axes, results: Results, data: pd.DataFrame, metric: str, options: FigureOptions) -> set[int]:
    x, y = str(options.x), str(options.by)
    groups = data.assign(**{VALUE: results.values(metric), BOUND: results.censored(metric)}).groupby([x, y], sort=False)
    rows, columns = _order(data[y]), _order(data[x])
    # Matplotlib cannot draw nullable types.
    means, bounds = (column.unstack(0).reindex(index=rows, columns=columns) for column in (groups[VALUE].mean().astype(float), groups[BOUND].any()))
    low, high = options.range
    low, high = means.min().min() if low is None else low, means.max().max() if high is None else high
    if low > high:
        raise _no_value(options, metric)
    norm = Normalize(low, high)
    image = axes.imshow(means, aspect="auto", origin="lower" if pd.api.types.is_numeric_dtype(data[y]) else "upper", cmap="viridis", norm=norm)
    _set_x_labels(axes, [_value(results, value) for value in columns])
    axes.set_yticks(range(len(rows)), [_value(results, value) for value in rows])
    axes.set(xlabel=_axis(results, x), ylabel=_axis(results, y))
    axes.grid(False)
    figure.colorbar(image, ax=axes, label=_axis(results, metric), pad=0.02)
    for (row, column), mean in np.ndenumerate(means.to_numpy(float)):
        if np.isfinite(mean) and (means.size <= MAX_CELLS or bounds.iat[row, column]):
            number = "" if means.size > MAX_CELLS else f"{mean:#.2g}".rstrip(".") if abs(mean) < 99.5 else f"{mean:.0f}"
            axes.text(column, row, ("≥" if bounds.iat[row, column] else "") + number, ha="center", va="center",
                      fontsize=matplotlib.rcParams["font.size"] - 2, color="white" if norm(mean) < 0.6 else "black")
    return set(groups[VALUE].count())


def _caption(results: Results, data: pd.DataFrame, metric: str, kind: str, x: str | None, counts: set[int]) -> str:
    title = _text(results, metric)
    runs = f"{_runs(counts)} per configuration" + (" and time" if x == TIME and len(counts) > 1 else "")
    if kind == "line":
        caption = f"{title} {'over simulated time' if x == TIME else f'against {_text(results, str(x))}'}: mean and 95 % bootstrap interval of {runs}."
    elif kind == "heat":
        caption = f"Mean {title} of {runs}."
    elif kind == "ecdf":
        estimate = "Kaplan-Meier estimate" if metric.startswith(CONVERGED) else "Empirical distribution"
        caption = f"{estimate} of {title} of {runs}, with 95 % intervals."
    else:
        when = "" if metric.startswith(CONVERGED) else " at the end"
        points = ("points for all runs" if max(counts, default=0) <= MAX_POINTS else "values beyond" if min(counts) > MAX_POINTS
                  else f"values beyond, or points for all runs of groups of up to {MAX_POINTS}")
        caption = f"{title}{when} of {runs}: median, quartiles, whiskers to the last value within 1.5 interquartile ranges, and {points}."
    if x == TIME:
        return caption
    censored, missing = results.censored(metric)[data.index].sum(), results.values(metric)[data.index].isna().sum()
    if censored:
        mark = {"line": "Hollow markers", "heat": "Cells with ≥", "box": "Triangles", "ecdf": "Vertical marks"}[kind]
        effect = "are censored" if kind == "ecdf" else "count with the end of their observation"
        caption += f" {mark}: {censored} of {len(data)} runs did not converge and {effect}."
    return caption + (f" {missing} runs without a value are omitted." if missing else "")


def _omitted(results: Results, keys: Sequence[str] = (), values: Sequence[Any] = ()) -> str:
    """Returns the sentence of a caption about the incomplete runs with these values of keys, or an empty string."""
    runs = results.runs[results.runs["status"] != "complete"]
    for key, value in zip(keys, values):
        runs = runs[runs[key] == value]
    return f" Omitted incomplete runs: {len(runs)}." if len(runs) else ""


def _line_style(index: int) -> dict[str, Any]:
    """Returns the colour, dashes and marker of a line."""
    return {"color": COLOURS[index % len(COLOURS)], "linestyle": LINES[index % len(LINES)], "marker": MARKERS[index % len(MARKERS)]}


@matplotlib.rc_context({**STYLE, "lines.markersize": 4})
def over_time(results: Results, metric: str) -> tuple[Figure, str]:
    """Plots the mean of a metric over simulated time with its 95 % bootstrap interval. Returns the figure and the caption."""
    metric = results.column(metric)
    data, lines = _first_values(results, results.selected_series)
    figure, panels, colour, groups, remark = _panels(results, data)
    counts: set[int] = set()
    for axes, group in zip(panels, groups):
        counts |= _line_over_time(axes, results, group, metric, colour)
        axes.set_xlabel("simulated time [s]")
    _finish(figure, panels, results, metric, colour)
    return figure, _caption(results, data, metric, "line", TIME, counts) + (f" Only {lines} are shown." if lines else "") + remark + _omitted(results)


@matplotlib.rc_context(STYLE)
def at_end(results: Results, metric: str) -> tuple[Figure, str]:
    """Draws box plots of a metric's values at the end of the runs. Returns the figure and the caption."""
    metric = results.column(metric)
    figure, panels, colour, groups, remark = _panels(results, results.complete)
    counts: set[int] = set()
    for axes, group in zip(panels, groups):
        counts |= _boxes(axes, results, group, metric, colour, None)
    _finish(figure, panels, results, metric, None)
    return figure, _caption(results, pd.concat(groups), metric, "box", colour, counts) + remark + _omitted(results)


def _first_values(results: Results, data: pd.DataFrame) -> tuple[pd.DataFrame, str]:
    """Returns the rows with the first values of the first key that varies, and a description of these values, or an empty string for all values."""
    key = next(iter(results.configuration), None)
    values = _order(results.runs[key]) if key else []
    if len(values) <= MAX_LINES:
        return data, ""
    return data[data[key].isin(values[:MAX_LINES])], f"the first {MAX_LINES} of {len(values)} values of {_text(results, str(key))}"


def _panels(results: Results, data: pd.DataFrame) -> tuple[Figure, list[Axes], str | None, list[pd.DataFrame], str]:
    """Returns the figure, its axes, the key that colours show, the rows of each panel, and the sentence of a caption about omitted panels."""
    if data.empty:
        raise ValueError("the tables contain no complete run to draw")
    keys = results.configuration
    require_distinct(data, keys)
    colour = keys[0] if keys else None
    # Titles also contain keys with one value.
    others = results.other_keys(keys[:1])
    parts = list(data.groupby(others, sort=False)) if others else [((), data)]
    remark = f" Only the first {MAX_PANELS} of {len(parts)} panels are shown." if len(parts) > MAX_PANELS else ""
    parts = parts[:MAX_PANELS]
    columns = min(COLUMNS, len(parts))
    rows = -(-len(parts) // columns)
    figure = Figure(figsize=(max(3.4, 2.3 * columns) + 0.6, 2.3 * rows + 0.7), layout="constrained")
    grid = figure.subplots(rows, columns, sharey=True, sharex=True, squeeze=False).flatten()
    for axes in grid[len(parts):]:
        axes.set_visible(False)
    for axes, (values, _) in zip(grid, parts):
        axes.set_title(textwrap.fill(_title(results, values, others), TITLE_LENGTH, break_long_words=False), fontsize=9)
    return figure, list(grid[:len(parts)]), colour, [group for _, group in parts], remark


def _split(results: Results, data: pd.DataFrame, key: str | None) -> list[tuple[int, pd.DataFrame]]:
    """Splits a table by the values of a key. Returns the index and the rows of each value. A value has the same index in all figures."""
    if key is None:
        return [(0, data)]
    parts = [(index, data[data[key] == value]) for index, value in enumerate(_order(results.runs[key]))]
    return [part for part in parts if len(part[1])]


def _names(results: Results, key: str) -> list[str]:
    """Returns the labels of all values of a key."""
    return [_value(results, value) for value in _order(results.runs[key])]


def _order(values: "pd.Series[Any]") -> list[Any]:
    """Returns the distinct values. Numbers are sorted, and other values are in the order of the experiment."""
    found = values.dropna().unique().tolist()
    return sorted(found) if pd.api.types.is_numeric_dtype(values) else found


def _finish(figure: Figure, panels: list[Axes], results: Results, metric: str, lines: str | None) -> None:
    """Adds the label of the metric, and a legend for the key that the lines show."""
    for index, axes in enumerate(panels):
        if index % COLUMNS == 0:
            axes.set_ylabel(_axis(results, metric))
    if lines:
        _add_legend(figure, results, lines)


def _axis(results: Results, name: str) -> str:
    """Returns the label of a metric or key, with its unit."""
    if name in results.labels:
        return results.labels[name]
    unit = "s" if name in results.convergence_times else results.units.get(name, "")
    return _text(results, name) + (f" [{unit}]" if unit else "")


def _text(results: Results, name: str) -> str:
    """Returns the label of a metric or key, without its unit."""
    if name in results.labels:
        return re.sub(r" *\[[^\]]*\]$", "", results.labels[name])
    if name in results.convergence_times:
        return f"time to convergence of {_text(results, name.removeprefix(CONVERGED))}"
    return re.sub(r"[\x00-\x1f\x7f_]", " ", name)


def _value(results: Results, value: Any) -> str:
    """Returns the label of a key's value."""
    name = text(value)
    return results.labels.get(name, name)


def _title(results: Results, values: tuple[Any, ...], keys: list[str]) -> str:
    """Formats a configuration: the label of each key, its last part, or the whole key if several have this part, and its value."""
    ends = [key.split(".")[-1] for key in keys]
    names = [_text(results, key) if key in results.labels else key if ends.count(end) > 1 else end for key, end in zip(keys, ends)]
    return ", ".join(f"{name} {_value(results, value.item() if hasattr(value, 'item') else value)}" for name, value in zip(names, values))


def _runs(counts: set[int]) -> str:
    low, high = min(counts, default=0), max(counts, default=0)
    return f"{high} run" + ("s" if high != 1 else "") if low == high else f"{low} to {high} runs"


def _table(results: Results, metric: str) -> str:
    if not results.configuration:
        return ""
    runs, values = _first_values(results, results.runs)
    effects = compare(replace(results, runs=runs), metric, results.configuration[0])
    if effects.empty:
        return ""
    # Values of keys must not be rounded, because rounded values could be equal.
    keys = list(effects.columns[:effects.columns.get_loc("n_a")])
    effects[keys] = effects[keys].map(lambda value: _value(results, value)).astype(str)
    table = effects.to_html(index=False, float_format=lambda number: f"{number:.3g}", na_rep="too few runs", border=0)
    return f"<details><summary>{html.escape(_text(results, metric))}: effect sizes{html.escape(values and f' of {values}')}</summary>{table}</details>"


def _page(title: str, results: Results, sections: list[str]) -> str:
    status = results.runs["status"].value_counts()
    counts = ", ".join(f"{count} {name}" for name, count in status.items())
    style = ("body{font:15px system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}figure{margin:2em 0}svg{max-width:100%;height:auto}"
             "table{border-collapse:collapse;font-size:13px}td,th{padding:2px 8px;text-align:right}")
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    return (f"<!doctype html><html lang=en><meta charset=utf-8><meta http-equiv=Content-Security-Policy content=\"{policy}\">"
            f"<title>{html.escape(title)}</title><style>{style}</style><h1>{html.escape(title)}</h1>"
            f"<p>Runs: {html.escape(counts)}.</p>{''.join(sections)}</html>\n")
