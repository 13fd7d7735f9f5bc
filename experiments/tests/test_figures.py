"""Tests the figures of ./collektive plot with their kinds, options, errors and files."""
import json
import os
import re
import shutil
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from matplotlib.collections import LineCollection

from collektive_experiments import ExperimentError, at_end, draw, load, over_time, plot, read, read_options, results
from collektive_experiments.__main__ import main
from collektive_experiments.tables import CONTENT, Table

LOSSES = (0.0, 0.1, 0.2, 0.4)
PROGRAMS = ("path-vector", "bellman-ford")
KINDS = {
    "line": ["--x", "network.loss", "--by", "program"],
    "time": ["--by", "program"],
    "box": ["--kind", "box", "--x", "network.loss", "--by", "program"],
    "heat": ["--kind", "heat", "--x", "network.loss", "--by", "program"],
    "ecdf": ["--kind", "ecdf", "--by", "program"],
}


def write_sweep(folder: Path, seeds: int = 5, losses: Sequence[float] = LOSSES, **settings: Any) -> str:
    """Writes the tables of a sweep. With one of the programs, runs with message loss do not converge."""
    random = np.random.default_rng(3)
    keys = {"program": PROGRAMS, "network.loss": losses, "seed": range(1, seeds + 1)}
    rows: list[dict[str, Any]] = []
    for program in PROGRAMS:
        for loss in losses:
            for seed in keys["seed"]:
                time = 2 + 10 * loss * (1 + PROGRAMS.index(program)) + random.normal(0, 0.3)
                rows.append({"run": f"{program}{loss}{seed}", "program": program, "network.loss": loss, "seed": seed, "status": "complete", "digest": "0",
                             "nodes": 49, "error": abs(random.normal(loss, 0.02)), "converged.error": time if time < 8 else None,
                             "censored.error": None if time < 8 else 8.0})
    series = [{name: row[name] for name in ("run", *keys)} | {"second": second, "error": 5.0 - second / 2 + row["error"], "links": 3}
              for row in rows for second in np.arange(0.0, 10.5, 0.5)]
    folder.mkdir(exist_ok=True)
    pd.DataFrame(rows).to_parquet(folder / "runs.parquet")
    pd.DataFrame(series).to_parquet(folder / "series.parquet")
    (folder / "sweep.json").write_text(json.dumps({"version": 3, "experiment": "e.json", "keys": list(keys), "set": {}, "measure": {"error": "m"}, **settings},
                                                  indent=1))
    return str(folder)


@pytest.fixture(scope="module")
def sweep(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The folder of a sweep without figures. Tests must not change it."""
    return write_sweep(tmp_path_factory.mktemp("figures") / "out")


@pytest.fixture
def out(sweep: str) -> Iterator[Path]:
    """The folder of the sweep. Its figures are deleted after each test."""
    yield Path(sweep)
    shutil.rmtree(Path(sweep) / "figures", ignore_errors=True)
    (Path(sweep) / "figures.html").unlink(missing_ok=True)


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_is_a_vector_file_with_embedded_fonts(out: Path, kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(out), "--metric", "error", *KINDS[kind], "--size", "3.3x2.2", "--style", "ieee"]) == 0
    paths = capsys.readouterr().out.split()
    assert len(paths) == 3 * (4 if kind in ("time", "ecdf") else 1), "each value of a key that is neither x nor by must have a figure"
    pdf = Path(paths[1]).read_bytes()
    assert b"/MediaBox [ 0 0 237.6 158.4 ]" in pdf
    assert b"/FontFile2" in pdf and b"/Type3" not in pdf
    assert b"STIXGeneral" in pdf


def test_the_same_tables_give_the_same_bytes(out: Path) -> None:
    options = {"metric": ["error", "converged.error"], "x": "network.loss", "by": "program", "kind": "box"}

    def contents() -> list[bytes]:
        return [Path(path).read_bytes() for path in plot(str(out), options=read_options(options))]
    expected = contents()
    assert contents() == expected
    with matplotlib.rc_context({"font.size": 30, "axes.facecolor": "red", "text.usetex": True}):
        assert contents() == expected, "a file matplotlibrc must not change figures"
        assert matplotlib.rcParams["font.size"] == 30


@pytest.mark.parametrize(("options", "message"), [
    ({"metric": "fault"}, "'metric' is 'fault', which does not exist"), ({"metric": "error", "by": "seed"}, "'by' is 'seed'"),
    ({"metric": "error", "kind": "box", "x": "program", "log": "y"}, "'log' is 'y', but 'error' has the value -1")])
def test_a_figure_in_python_is_checked_like_that_of_a_command(sweep: str, options: dict[str, Any], message: str) -> None:
    results = load(sweep)
    results.runs.loc[0, "error"] = -1
    with pytest.raises(ExperimentError, match=message):
        next(draw(results, read_options(options)))


@pytest.mark.slow
def test_limits_may_be_negative(out: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(out), "--metric", "error", "--range", "-5:-1.5"]) == 0, capsys.readouterr().err


@pytest.mark.parametrize(("words", "message"), [
    (["--kind", "pie"], "--kind is 'pie'; it must be one of: line, box, heat, ecdf"),
    (["--style", "nature"], "--style is 'nature'; it must be one of: plain, ieee, acm"),
    (["--log", "z"], "--log is 'z'; it must be one of: x, y, xy"),
    (["--size", "3.3"], "--size is '3.3'; it must be a width and a height in inches, such as 3.3x2.2"),
    (["--size", "3..3x2"], "--size is '3..3x2'; it must be a width and a height in inches"),
    (["--size", "330x220"], "--size is '330x220'; width and height must be from 1 to 20 inches"),
    (["--range", "3"], "--range is '3'; it must be one or two limits"),
    (["--range", "0:1:2"], "--range is '0:1:2'; it must be one or two limits"),
    (["--range", "1:0"], "--range is '1:0'; the first limit must be below the second"),
    (["--range", "0:inf"], "--range is '0:inf'; its limits must be finite"),
    (["--range", "0:1", "--log", "y"], "--range is '0:1', but a logarithmic axis needs limits above 0"),
    (["--range", "1000:"], "--range contains no value of 'error' in at least one figure; set both limits"),
    (["--range", ":-1000", "--kind", "box", "--x", "program"], "--range contains no value of 'error' in at least one figure; set both limits"),
    (["--range", "1000:", "--kind", "ecdf"], "--range contains no value of 'error' in at least one figure; set both limits"),
    (["--range", ":-1000", "--kind", "heat", "--x", "program", "--by", "network.loss"],
     "--range contains no value of 'error' in at least one figure; set both limits"),
    (["--x", "loss"], "--x is 'loss', which does not vary; these vary: program, network.loss, time"),
    (["--x", "program"], "--x is 'program', whose values are not numbers; use the kind 'box'"),
    (["--x", "network.loss", "--log", "x"], "--log is 'x', but 'network.loss' has the value 0.0, and a logarithmic axis needs values above 0"),
    (["--x", "seed"], "--x is 'seed', but runs with different seeds are repetitions"),
    (["--by", "programme"], "--by is 'programme', which does not vary; these vary: program, network.loss"),
    (["--by", "program", "--x", "program", "--kind", "box"], "--by is 'program', which is also x"),
    (["--kind", "box"], "--x is missing; the kind 'box' needs the key of the horizontal axis"),
    (["--kind", "box", "--x", "time"], "--x is 'time', which only the kind 'line' can draw"),
    (["--kind", "box", "--x", "program", "--log", "x"], "--log is 'x', but the x axis of the kind 'box' cannot be logarithmic"),
    (["--kind", "heat", "--x", "program"], "--by is missing; the kind 'heat' needs the key of the vertical axis"),
    (["--kind", "heat", "--x", "program", "--by", "network.loss", "--log", "y"], "--log is 'y', but the y axis of the kind 'heat' cannot be logarithmic"),
    (["--kind", "ecdf", "--x", "network.loss"], "--x is 'network.loss', but the horizontal axis of the kind 'ecdf' is the metric; use by"),
    (["--metric", "eror"], "--metric is 'eror', which does not exist; existing metrics: error"),
    (["--metric", "eror", "--x", "network.loss"], "--metric is 'eror', which does not exist; existing metrics: error, converged.error, nodes"),
    (["--metric", "digest", "--x", "network.loss"], "--metric is 'digest', which does not exist"),
    (["--metric", "converged.error"], "--metric is 'converged.error', which has one value per run; name a key with x, or use the kind 'ecdf'"),
    (["--metric", "error", "error"], "--metric contains 'error' twice"), (["--metric", "error", "--metric", "error"], "--metric contains 'error' twice"),
    (["--by", "program", "--size", "1x1"], "--size leaves too little space for labels: 1x1; enlarge it, or set shorter labels"),
    (["--experiment", "missing.json"], "'missing.json' cannot be read"),
])
def test_invalid_options_are_a_one_line_error_and_no_file_is_written(out: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(out), *(words if "--metric" in words else ["--metric", "error", *words])]) == 1
    output, errors = capsys.readouterr()
    assert output == "" and errors.count("\n") == 1
    assert message in errors
    assert not (out / "figures").exists()


def test_options_of_a_figure_need_a_metric(sweep: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", sweep, "--x", "network.loss"]) == 1
    assert capsys.readouterr().err == "collektive: plot: --metric must name at least one metric\n"


@pytest.mark.parametrize(("line", "keys", "message"), [
    (5, '"figures": 3', "'figures' must be a list of objects"),
    (6, '"figures": [\n3]', "'figures[0]' is 3; it must be an object"),
    (7, '"figures": [\n{"metric": "error",\n"colour": "red"}]', "'figures[0].colour' is unknown; known here: metric, x, by"),
    (6, '"figures": [{"metric": "error",\n"size": 3}]', "'figures[0].size' must be a string"),
    (5, '"figures": [{"x": "time"},\n{}]', "'figures[0].metric' must name at least one metric"),
    (6, '"figures": [{"metric": ["error"]},\n{"metric": ["error", 3]}]', "'figures[1].metric' must name at least one metric"),
    (6, '"figures": [{"metric": "error",\n"x": "los"}]', "'figures[0].x' is 'los', which does not vary; these vary: loss, program"),
    (6, '"figures": [{"metric": "error", "x": "loss",\n"log": "x"}]', "'figures[0].log' is 'x', but 'loss' has the value 0"),
    (6, '"figures": [{"metric": "error",\n"by": "program"}]', "'figures[0].by' is 'program', which has more than 10 values"),
    (5, '"labels": []', "'labels' must be an object"),
    (6, '"labels": {\n"error": ""}', "'labels.error' is \"\"; it must be a non-empty string of one line"),
])
def test_errors_in_figures_of_an_experiment_have_a_line(tmp_path: Path, line: int, keys: str, message: str) -> None:
    (tmp_path / "scenario.json").write_text("{}")
    path = tmp_path / "experiment.json"
    path.write_text('{"version": 1,\n"scenario": "scenario.json",\n"vary": {"loss": [0, 1],\n"program": "1-11", "seed": "1-2"},\n' + keys + "}")
    with pytest.raises(ExperimentError) as error:
        read(str(path))
    assert f"experiment.json:{line}: {message}" in str(error.value)


def test_figures_and_labels_of_the_experiment_are_on_the_page(tmp_path: Path) -> None:
    labels = {"network.loss": "message loss", "error": "mean error [m]", "bellman-ford": "Bellman-Ford"}
    folder = write_sweep(tmp_path / "out", 3, (0, 0.4), figures=[{"metric": "error", "x": "network.loss", "by": "program"}], labels=labels)
    paths = plot(folder)
    assert f"{folder}/figures/error-line-network.loss-program.pdf" in paths
    page = (tmp_path / "out/figures.html").read_text()
    assert page.count("<svg") == 4
    assert {"message loss", "mean error [m]", "Bellman-Ford"} <= set(re.findall(">([^<]+)</text>", page))
    assert "mean error against message loss: mean and 95 % bootstrap interval of 3 runs per configuration." in page
    # The figures and labels of another file replace the sweep's figures and labels.
    (tmp_path / "scenario.json").write_text("{}")
    experiment: dict[str, Any] = {"version": 1, "scenario": "scenario.json", "vary": {"program": list(PROGRAMS), "network.loss": list(LOSSES), "seed": [1]}}
    (tmp_path / "e.json").write_text(json.dumps({**experiment, "labels": {"eror": "x"}}))
    assert main(["plot", folder, "--experiment", str(tmp_path / "e.json")]) == 1
    (tmp_path / "e.json").write_text(json.dumps(experiment))
    paths = plot(folder, options=read_options({"metric": "nodes", "x": "network.loss"}), experiment=read(str(tmp_path / "e.json")))
    assert "nodes against network.loss" in Path(paths[2]).read_text()


def test_two_figures_with_the_same_name_are_an_error(tmp_path: Path) -> None:
    figure = {"metric": "error", "x": "network.loss"}
    with pytest.raises(ExperimentError, match=r"sweep.json:\d+: 'figures\[1\].metric' .* describe an existing figure: 'error-line-network.loss-"):
        plot(write_sweep(tmp_path / "out", 1, figures=[figure, figure]))
    assert not (tmp_path / "out/figures").exists()
    # A requested figure must not have the same name as the figure of a metric either.
    folder = write_sweep(tmp_path / "one", 3, (0.0,), figures=[{"metric": "error"}])
    for path in (tmp_path / "one/runs.parquet", tmp_path / "one/series.parquet"):
        table = pd.read_parquet(path).query("program == 'bellman-ford'")
        table.insert(list(table.columns).index("error"), "error-line", table["error"])
        table.to_parquet(path)
    with pytest.raises(ExperimentError, match="describe an existing figure: 'error-line-time'"):
        plot(folder)


def test_metrics_that_differ_only_in_case_have_distinct_files(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0,), figures=[{"metric": ["nodes", "Nodes"], "kind": "ecdf"}])
    for path in (tmp_path / "out/runs.parquet", tmp_path / "out/series.parquet"):
        table = pd.read_parquet(path)
        table.insert(list(table.columns).index("error"), "Error", table["error"])
        table["Nodes"] = 1
        table.to_parquet(path)
    names = [Path(path).name for path in plot(folder)]
    assert len({name.lower() for name in names}) == len(names)
    # The names do not depend on the chosen figures.
    assert {Path(path).name for path in plot(folder, metrics=["error"])} < set(names)
    assert {Path(path).name for path in plot(folder, options=read_options({"metric": "Nodes", "kind": "ecdf"}))} < set(names)


def test_runs_that_do_not_converge_are_censored_in_each_kind(sweep: str) -> None:
    results = load(sweep)
    censored = results.censored("converged.error")
    assert 0 < censored.sum() < len(censored)
    assert set(results.values("converged.error")[censored]) == {8.0}
    for kind, mark in (("line", "Hollow markers"), ("box", "Triangles"), ("heat", "Cells with ≥"), ("ecdf", "Vertical marks")):
        options = read_options({"metric": "converged.error", "kind": kind, "by": "program"} | ({} if kind == "ecdf" else {"x": "network.loss"}))
        captions = [caption for _, _, caption in draw(results, options)]
        assert f"{mark}: {censored.sum()} of " in "".join(captions) or kind == "ecdf"
        assert mark in captions[-1]


def test_runs_that_do_not_converge_are_marked_in_large_figures(tmp_path: Path) -> None:
    results = load(write_sweep(tmp_path / "runs", seeds=21))
    (_, figure, caption), = draw(results, read_options({"metric": "converged.error", "kind": "box", "by": "program", "x": "network.loss"}))
    assert "Triangles: " in caption
    assert [list(line.get_ydata()) for line in figure.axes[0].get_lines() if line.get_marker() == "^" and len(line.get_ydata())] == [[8.0]]
    results = load(write_sweep(tmp_path / "cells", 1, np.linspace(0, 0.4, 33).tolist()))
    (_, figure, caption), = draw(results, read_options({"metric": "converged.error", "kind": "heat", "by": "program", "x": "network.loss"}))
    assert "Cells with ≥: " in caption
    assert [entry.get_text() for entry in figure.axes[0].texts] == ["≥"] * results.censored("converged.error").sum()


def test_a_key_that_depends_on_x_does_not_divide_figures(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", seeds=2)
    for name in ("runs", "series"):
        table = pd.read_parquet(f"{folder}/{name}.parquet")
        table.insert(1, "label", table["network.loss"].map(lambda loss: f"loss {loss}"))
        table.to_parquet(f"{folder}/{name}.parquet")
    settings = json.loads((tmp_path / "out/sweep.json").read_text())
    (tmp_path / "out/sweep.json").write_text(json.dumps({**settings, "keys": ["program", "network.loss", "label", "seed"]}))
    options = read_options({"metric": "nodes", "x": "network.loss", "by": "program"})
    assert len(list(draw(load(folder), options))) == 1


def test_panels_without_runs_of_a_value_have_the_same_labels_as_the_others(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0, 0.4))
    for name in ("runs", "series"):
        table = pd.read_parquet(f"{folder}/{name}.parquet")
        is_failed = (table["program"] == "path-vector") & (table["network.loss"] == 0)
        table = table[~is_failed] if name == "series" else table.assign(status=np.where(is_failed, "failed", "complete"))
        table.to_parquet(f"{folder}/{name}.parquet")
    (figure, panel_caption), (lines, _) = (draw_panels(load(folder), "error") for draw_panels in (at_end, over_time))
    assert [[tick.get_text() for tick in axes.get_xticklabels()] for axes in figure.axes] == [["path-vector", "bellman-ford"]] * 2
    assert "Omitted incomplete runs: 2." in panel_caption
    captions = [caption for _, _, caption in draw(load(folder), read_options({"metric": "error", "by": "program"}))]
    assert {caption.split("loss ")[1]: "Omitted incomplete runs: 2. " in caption for caption in captions} == {"0.": True, "0.4.": False}
    boxes = [{round(float(np.mean(curve.get_xdata()))) for curve in axes.get_lines() if curve.get_marker() == "o"} for axes in figure.axes]
    assert boxes == [{0, 1}, {1}]
    assert [entry.get_text() for entry in lines.legends[0].get_texts()] == ["path-vector", "bellman-ford"]


def test_a_folder_named_like_the_home_folder_has_its_own_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_sweep(tmp_path / "home", 1)
    write_sweep(tmp_path / "~", 2)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)
    results = load("~")
    assert (len(results.runs), results.series["run"].nunique()) == (16, 16)


def test_units_belong_to_metrics_although_the_settings_are_newer_than_the_tables(tmp_path: Path) -> None:
    assert load(write_sweep(tmp_path / "out", 1, measure={"time": "s", "error": "m"})).units == {"error": "m"}


def test_whole_numbers_of_nodes_keep_their_digits_beside_empty_cells(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1)
    big = pa.array([None, (1 << 53) + 1])
    pq.write_table(pa.table({"run": ["a", "a"], "signed": big, "unsigned": big.cast(pa.uint64()), "share": [None, 0.5]}), f"{folder}/nodes.parquet")
    nodes = load(folder).nodes
    assert nodes is not None
    assert [str(nodes[name][1]) for name in ("signed", "unsigned", "share")] == ["9007199254740993", "9007199254740993", "0.5"]
    assert nodes.isna().sum().tolist() == [0, 1, 1, 1]


def test_booleans_of_nodes_can_be_negated_beside_empty_cells(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1)
    pq.write_table(pa.table({"run": ["a"] * 4, "flag": [None, True, False, False]}), f"{folder}/nodes.parquet")
    nodes = load(folder).nodes
    assert nodes is not None
    assert (~nodes["flag"]).sum() == 2
    assert len(nodes[nodes["flag"]]) == 1


def test_numbers_on_axes_and_in_cells_are_not_rounded_to_fewer_digits(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1, (1000001, 1000002), labels={"1000002": "last"})
    pd.read_parquet(f"{folder}/runs.parquet").assign(error=99.7).to_parquet(f"{folder}/runs.parquet")
    (_, figure, _), *_ = draw(load(folder), read_options({"metric": "error", "x": "network.loss", "by": "program", "log": "x"}))
    assert [tick.get_text() for tick in figure.axes[0].get_xticklabels()] == ["1000001", "last"]
    (_, figure, _), *_ = draw(load(folder), read_options({"metric": "error", "x": "network.loss", "by": "program", "kind": "heat"}))
    assert {text.get_text() for text in figure.axes[0].texts} == {"100"}


def test_ticks_of_logarithmic_axes_between_two_powers_have_different_labels(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 3)
    table = pd.read_parquet(f"{folder}/runs.parquet")
    for low, high, label in ((12000, 13000, "1.25·10⁴"), (100, 100.0003, "100.0001")):
        table.assign(error=np.linspace(low, high, len(table))).to_parquet(f"{folder}/runs.parquet")
        (_, figure, _), *_ = draw(load(folder), read_options({"metric": "error", "x": "network.loss", "log": "y"}))
        axis = figure.axes[0].yaxis
        found = [tick.get_text() for tick in axis.get_ticklabels(which="both") if tick.get_text()]
        assert label in found and len(set(found)) == len(found)


def test_legends_contain_empty_values_and_values_that_start_with_an_underscore(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 3, (0.0, 0.1))
    for name in ("runs", "series"):
        table = pd.read_parquet(f"{folder}/{name}.parquet")
        table.assign(program=table["program"].replace({"path-vector": "_under", "bellman-ford": ""})).to_parquet(f"{folder}/{name}.parquet")
    for kind in KINDS.values():
        options = {"metric": "error", "by": "program", **{option[2:]: value for option, value in zip(kind[::2], kind[1::2])}}
        (_, figure, _), *_ = draw(load(folder), read_options(options))
        assert [entry.get_text() for legend in figure.legends for entry in legend.get_texts()] == ["_under", ""] * (options.get("kind") != "heat")


def test_titles_of_panels_do_not_overlap(tmp_path: Path) -> None:
    values = (0.25, 0.5, 0.75, 1.0)
    results_of_panels = load(write_sweep(tmp_path / "out", 1, values, labels={"network.loss": "probability of the loss of a message in a burst"}))
    for draw_panels in (at_end, over_time):
        figure, _ = draw_panels(results_of_panels, "error")
        figure.draw_without_rendering()
        boxes = [axes.title.get_window_extent() for axes in figure.axes]
        assert all(left.x1 < right.x0 for left, right in pairwise(boxes)) and boxes[-1].x1 <= figure.bbox.width
        assert [axes.get_title().replace("\n", " ").split()[-1] for axes in figure.axes] == ["0.25", "0.5", "0.75", "1"]


def test_captions_of_box_plots_name_the_points_of_all_groups(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path, 21)
    runs = pd.read_parquet(tmp_path / "runs.parquet")
    for missing, points in ((0, "and values beyond."), (1, "and values beyond, or points for all runs of groups of up to 20.")):
        runs.iloc[missing:].to_parquet(tmp_path / "runs.parquet")
        (_, _, caption), = draw(load(folder), read_options({"metric": "error", "kind": "box", "by": "program", "x": "network.loss"}))
        assert caption.endswith(points)


def test_captions_state_how_many_panels_are_missing(tmp_path: Path) -> None:
    for panels, remark in ((24, ""), (25, "Only the first 24 of 25 panels are shown.")):
        results_of_panels = load(write_sweep(tmp_path / str(panels), 1, tuple(float(index) for index in range(panels))))
        for draw_panels in (at_end, over_time):
            figure, caption = draw_panels(results_of_panels, "error")
            assert len(figure.axes) == 24 and ("panels" in caption) == bool(remark) and remark in caption
        assert "Triangles: 46 of 48 runs did not converge" in at_end(results_of_panels, "converged.error")[1]


def test_many_values_do_not_hide_figures_over_time_behind_their_legend(tmp_path: Path) -> None:
    for values, remark in ((24, ""), (25, "Only the first 24 of 25 values of network.loss are shown.")):
        losses = tuple(index / values for index in range(values))
        folder = write_sweep(tmp_path / str(values), 1, losses, keys=["network.loss", "program", "seed"])
        figure, caption = over_time(load(folder), "error")
        assert len(figure.legends[0].get_texts()) == 24
        assert ("Only" in caption) == bool(remark) and remark in caption
    plot(folder, ["error"])
    page = Path(folder, "figures.html").read_text()
    assert "error: effect sizes of the first 24 of 25 values of network.loss</summary>" in page
    assert page.count("<td>0</td>") == 2 * 23


def test_long_labels_do_not_overlap(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1, tuple(1000000.5 + index for index in range(6)))
    for kind in ("box", "heat"):
        (_, figure, _), *_ = draw(load(folder), read_options({"metric": "error", "x": "network.loss", "by": "program", "kind": kind}))
        assert {tick.get_rotation() for tick in figure.axes[0].get_xticklabels()} == {30}, kind


@pytest.mark.parametrize("kind", ["line", "box", "heat"])
def test_convergence_times_of_long_metrics_fit_the_default_size(tmp_path: Path, kind: str) -> None:
    folder = write_sweep(tmp_path / "out")
    for name in ("runs", "series"):
        table = pd.read_parquet(f"{folder}/{name}.parquet")
        table.rename(columns=lambda column: column.replace("error", "distance_error")).to_parquet(f"{folder}/{name}.parquet")
    svg, *_ = plot(folder, options=read_options({"metric": "converged.distance_error", "x": "network.loss", "by": "program", "kind": kind}))
    assert {"time to convergence of", "distance error [s]"} <= {element.text for element in ElementTree.parse(svg).iter()}


def test_figures_grow_around_labels_that_are_too_long(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1, (0.0,), labels={"path-vector": "a path of " + 20 * "many words ", "error": 12 * "long name "})
    for path in plot(folder):
        if path.endswith(".svg") and "converged" not in path:
            assert float(ElementTree.parse(path).getroot().attrib["width"].removesuffix("pt")) > 72 * 10, path


@pytest.mark.filterwarnings("error")
def test_missing_glyphs_are_one_line_for_each_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_sweep(tmp_path / "out", 1, (0.0,), labels={"path-vector": "\N{ANT}"})
    plot(folder, options=read_options({"metric": "error", "by": "program"}))
    assert capsys.readouterr().err == "collektive: Glyph 128028 (\\N{ANT}) missing from font(s) DejaVu Sans.\n"


def test_figures_with_control_characters_in_values_are_well_formed(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1, (0.0,))
    for name in ("runs", "series"):
        table = pd.read_parquet(f"{folder}/{name}.parquet")
        table.assign(program=table["program"].replace({"path-vector": "a\x01b", "bellman-ford": "c\ufffe"})).to_parquet(f"{folder}/{name}.parquet")
    svg, *_ = plot(folder, options=read_options({"metric": "error", "by": "program"}))
    assert {"a\ufffdb", "c\ufffd"} <= {element.text for element in ElementTree.parse(svg).iter()}


def test_keys_of_one_zip_share_a_panel(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0, 0.4))
    for name in ("runs", "series"):
        table = pd.read_parquet(f"{folder}/{name}.parquet")
        table[(table["program"] == "path-vector") == (table["network.loss"] == 0)].to_parquet(f"{folder}/{name}.parquet")
    # Sweeps of earlier versions did not write which keys are zipped.
    assert len(at_end(load(folder), "error")[0].axes) == 1
    settings = json.loads((tmp_path / "out/sweep.json").read_text())
    for zipped, panels in ((["program", "network.loss"], 1), ([], 2)):
        (tmp_path / "out/sweep.json").write_text(json.dumps({**settings, "zip": zipped}))
        assert len(at_end(load(folder), "error")[0].axes) == panels


def test_effect_sizes_show_exact_values_of_keys(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 2, (1000.5, 1001.5), keys=["network.loss", "program", "seed"])
    plot(folder)
    assert {"<td>1000.5</td>", "<td>1001.5</td>"} <= set(re.findall("<td>.*?</td>", (tmp_path / "out/figures.html").read_text()))


def test_a_band_as_key_is_not_labelled_as_a_time(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0, 0.4), keys=["converged.error.to", "program", "seed"])
    for name in ("runs", "series"):
        pd.read_parquet(f"{folder}/{name}.parquet").rename(columns={"network.loss": "converged.error.to"}).to_parquet(f"{folder}/{name}.parquet")
    (_, figure, caption), *_ = draw(load(folder), read_options({"metric": "error", "x": "converged.error.to", "by": "program"}))
    assert figure.axes[0].get_xlabel() == "converged.error.to"
    assert caption.startswith("error against converged.error.to: ")


@pytest.mark.slow
def test_a_metric_with_the_name_of_another_column_is_drawn_instead_of_this_column(tmp_path: Path) -> None:
    figures = [{"metric": "nodes", "x": "network.loss", "by": "program"}, {"metric": "nodes", "by": "program"}]
    folder = write_sweep(tmp_path / "out", 2, (0.0, 0.4), measure={"nodes": "m"}, figures=figures, labels={"nodes": "active nodes"})
    for name in ("runs", "series"):
        pd.read_parquet(f"{folder}/{name}.parquet").rename(columns={"error": "metric.nodes"}).to_parquet(f"{folder}/{name}.parquet")
    plot(folder)
    for options in figures:
        (_, figure, caption), *_ = draw(load(folder), read_options(options))
        assert caption.startswith("active nodes ") and figure.axes[0].get_ylabel() == "active nodes"
        assert max(line.get_ydata().max() for line in figure.axes[0].get_lines() if len(line.get_ydata())) < 49


def test_missing_values_are_not_drawn(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 3, (0.0,))
    series = pd.read_parquet(f"{folder}/series.parquet")
    series.loc[series["second"] == 5, "error"] = None
    series.to_parquet(f"{folder}/series.parquet")
    runs = pd.read_parquet(f"{folder}/runs.parquet")
    runs.loc[runs["program"] == "bellman-ford", "error"] = None
    runs.to_parquet(f"{folder}/runs.parquet")
    (_, figure, caption), = draw(load(folder), read_options({"metric": "error", "by": "program"}))
    assert [np.isnan(line.get_ydata()).sum() for line in figure.axes[0].get_lines()] == [1, 1]
    assert "interval of 3 runs per configuration." in caption
    (_, figure, caption), = draw(load(folder), read_options({"metric": "error", "by": "program", "kind": "ecdf"}))
    assert [entry.get_text() for entry in figure.legends[0].get_texts()] == ["path-vector"]


def test_values_between_missing_values_are_drawn_with_their_interval(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 3, (0.0,))
    series = pd.read_parquet(f"{folder}/series.parquet")
    series.loc[series["second"] % 1 == 0, "error"] = None
    series.to_parquet(f"{folder}/series.parquet")
    (_, figure, _), = draw(load(folder), read_options({"metric": "error", "by": "program"}))
    axes = figure.axes[0]
    for line in axes.get_lines():
        assert set(np.flatnonzero(np.isfinite(line.get_ydata()))) <= set(line.get_markevery())
    intervals = [len(lines.get_segments()) for lines in axes.collections if isinstance(lines, LineCollection)]
    assert intervals == [series["second"].nunique() // 2] * len(PROGRAMS)


def test_means_that_differ_from_their_interval_by_a_rounding_error_are_drawn(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 12, (0.0,))
    runs = pd.read_parquet(f"{folder}/runs.parquet")
    # The mean of these values is below the interval, because resampled values are added in other orders.
    values = 28.066399068880933 + np.array([-1, -1, 0, 1, 0, -1, 0, -1, 0, 1, 2, 2]) * np.spacing(28.0)
    runs.assign(error=[*values] * 2).to_parquet(f"{folder}/runs.parquet")
    assert len(list(draw(load(folder), read_options({"metric": "error", "x": "network.loss", "by": "program"})))) == 1


def test_metrics_beyond_the_limit_of_figures_are_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0,))
    pd.read_parquet(f"{folder}/runs.parquet").assign(error=sys.float_info.max).to_parquet(f"{folder}/runs.parquet")
    names = {Path(path).name for path in plot(folder)}
    assert "converged.error-end.svg" in names and "error-end.svg" not in names
    assert "the metric 'error' is not drawn: it has values beyond 1e+300" in capsys.readouterr().err
    assert main(["plot", folder, "--metric", "error", "--kind", "ecdf"]) == 1
    assert "--metric is 'error', which has values beyond 1e+300" in capsys.readouterr().err


def test_runs_that_ended_after_the_tables_were_written_are_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0,))
    for name, status in (("path-vector0.01", "complete"), ("later", "complete"), ("failed", "failed"), ("running.part", "complete")):
        (tmp_path / "out/runs" / name).mkdir(parents=True)
        record = {"name": name.removesuffix(".part"), "status": status, "message": "", "files": {"manifest.json": "", "metrics.csv": ""}}
        (tmp_path / "out/runs" / name / "run.json").write_text(json.dumps(record))
    plot(folder)
    assert "the figures omit because they are not in the tables: 1; the sweep has not ended, or" in capsys.readouterr().err


def test_figures_that_are_older_than_the_tables_are_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_sweep(tmp_path / "out", 2, (0.0,))
    for path in plot(folder):
        os.utime(path, (1, 1))
    capsys.readouterr()
    plot(folder, ["error"])
    expected = "these figures are older than the tables: figures/converged.error-end.pdf; draw them again, or delete them"
    assert expected in capsys.readouterr().err
    (tmp_path / "out/figures/converged.error-end.pdf").unlink()
    plot(folder, ["error"])
    assert "older" not in capsys.readouterr().err


def test_tables_that_a_sweep_replaces_at_the_same_time_are_not_mixed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def write_tables(seeds: int) -> str:
        folder = write_sweep(tmp_path / "out", seeds, (0.0,))
        for name in ("runs", "series"):
            path = f"{folder}/{name}.parquet"
            pq.write_table(pq.read_table(path).replace_schema_metadata({CONTENT: str(seeds)}), path)
        return folder

    def replace_after_the_first(folder: str, name: str) -> tuple[pd.DataFrame, bytes | None]:
        table = read_table(folder, name)
        if name == "runs":
            write_tables(3)
        return table

    read_table = results._read
    folder = write_tables(2)
    monkeypatch.setattr(results, "_read", replace_after_the_first)
    with pytest.raises(ExperimentError, match="do not belong together: if a sweep is writing them, try again"):
        load(folder)


def test_changed_values_in_tables_are_an_error(tmp_path: Path) -> None:
    folder = write_sweep(tmp_path / "out", 1)
    series = pq.read_table(f"{folder}/series.parquet")
    with Table(f"{folder}/series", series.schema, False) as table:
        for row in series.to_pylist():
            table.add(row)
    table.publish()
    path = Path(folder, "series.parquet")
    path.write_bytes(path.read_bytes().replace(b"path-vector", b"path-sector", 1))
    with pytest.raises(ExperimentError, match=r"no usable series\.parquet"):
        load(folder)


def test_an_estimate_ends_with_the_observation_of_its_runs(tmp_path: Path) -> None:
    results = load(write_sweep(tmp_path / "out", losses=(0.4,)))
    is_short = (results.runs["program"] == "bellman-ford") & results.runs["converged.error"].isna()
    results.runs.loc[is_short, "censored.error"] = 4.0
    (_, figure, _), = draw(results, read_options({"metric": "converged.error", "kind": "ecdf", "by": "program"}))
    converged = results.values("converged.error")
    ends = [converged[results.runs["program"] == program].max() for program in PROGRAMS]
    assert ends[1] == 4 < ends[0]
    assert [line.get_xdata()[-1] for line in figure.axes[0].lines if line.get_label() in ("0", "1")] == [ends[0], 4]

    # An estimate whose last run has converged is known until the end.
    results.runs.loc[is_short.idxmax(), "converged.error"] = 5.0
    (_, figure, _), = draw(results, read_options({"metric": "converged.error", "kind": "ecdf", "by": "program"}))
    assert [line.get_xdata()[-1] for line in figure.axes[0].lines if line.get_label() in ("0", "1")] == [ends[0]] * 2


def test_axes_support_scales_limits_and_points(sweep: str) -> None:
    def axes(**options: str) -> Any:
        (_, figure, _), *_ = draw(load(sweep), read_options({"metric": "error", "by": "program", **options}))
        return figure.axes[0]
    line = axes(x="network.loss", log="y", range="0.001:")
    assert (line.get_yscale(), line.get_ylim()[0]) == ("log", 0.001)
    format_tick = line.yaxis.get_major_formatter()
    assert [format_tick(value) for value in (0.0001, 0.01, 1, 1000, 100000)] == ["10⁻⁴", "0.01", "1", "1000", "10⁵"]
    assert len({(curve.get_linestyle(), curve.get_marker()) for curve in line.get_lines() if curve.get_linestyle() != "None"} - {("None", "None")}) >= 2
    box = axes(kind="box", x="network.loss")
    points = [curve for curve in box.get_lines() if curve.get_marker() == "o"]
    assert sum(len(curve.get_xdata()) for curve in points) == 40
    assert [tick.get_text() for tick in box.get_xticklabels()] == ["0", "0.1", "0.2", "0.4"]
    assert axes(kind="heat", x="network.loss").images[0].get_array().shape == (2, 4)


@pytest.mark.parametrize("backend", ["numpy_nullable", "pyarrow"])
def test_a_heat_map_accepts_tables_with_nullable_types(sweep: str, backend: Any) -> None:
    results = load(sweep)
    options = read_options({"metric": "error", "kind": "heat", "x": "network.loss", "by": "program"})
    (_, plain, _), (_, typed, _) = [next(draw(each, options)) for each in (results, replace(results, runs=results.runs.convert_dtypes(dtype_backend=backend)))]
    assert np.allclose(typed.axes[0].images[0].get_array(), plain.axes[0].images[0].get_array())


def test_figures_over_time_omit_runs_that_are_not_in_a_filtered_table(sweep: str) -> None:
    everything = load(sweep)
    selected = replace(everything, runs=everything.runs[everything.runs["network.loss"] == 0.4])
    expected = replace(selected, series=everything.series[everything.series["network.loss"] == 0.4])
    options = read_options({"metric": "error", "by": "program"})
    (_, _, caption), = draw(selected, options)
    assert caption == next(draw(expected, options))[2]
    assert "of 5 runs per configuration" in caption
    lines = [[line.get_ydata() for line in over_time(each, "error")[0].axes[0].get_lines()] for each in (selected, expected)]
    assert np.array_equal(*lines)
    for draw_figure in (over_time, at_end):
        with pytest.raises(ValueError, match="no complete run"):
            draw_figure(replace(everything, runs=everything.runs[:0]), "error")
