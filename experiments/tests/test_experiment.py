"""Tests that errors in experiment files are reported with their line, before the first run."""
import json
import os
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pyarrow as pa
import pytest

from collektive_experiments import ExperimentError, read
from collektive_experiments.__main__ import main
from collektive_experiments.experiment import name_of
from collektive_experiments.positions import Located
from collektive_experiments.sweep import _check_figures
from collektive_experiments.tables import _type_of, _value


def write(folder: Path, text: str) -> str:
    (folder / "scenario.json").write_text("{}")
    path = folder / "experiment.json"
    path.write_text(text)
    return str(path)


@pytest.mark.parametrize(("line", "text", "message"), [
    (1, '{"version": 1}', "the key 'scenario' is missing"),
    (3, '{"version": 1,\n"scenario": "scenario.json",\n"varry": {}}', "unknown key 'varry'; known here: version, scenario, vary"),
    (2, '{"version": 1,\n"scenario": 3}', "'scenario' is 3; it must be a string"),
    (2, '{"version": 1,\n"scenario": "other.json"}', "other.json' does not exist"),
    (2, '{"version": 1,\n"scenario": "experiment.json"}', "experiment.json' is the manifest of a run or an experiment"),
    (1, '{"version": 2, "scenario": "scenario.json"}', "version 2 is not supported"),
    (1, '{"version": true, "scenario": "scenario.json"}', "'version' is true; it must be a whole number"),
    (3, '{"version": 1, "scenario": "scenario.json",\n"vary": {\n"seed": []}}', "'vary.seed' is an empty list"),
    (3, '{"version": 1, "scenario": "scenario.json",\n"vary": {\n"seed": 3}}', "'vary.seed' is 3; it must be a list or a range"),
    (3, '{"version": 1, "scenario": "scenario.json",\n"vary": {\n"seed": "1 to 3"}}', "is not a range"),
    (3, '{"version": 1, "scenario": "scenario.json",\n"vary": {\n"seed": "3-1"}}', "contains no values"),
    (3, '{"version": 1, "scenario": "scenario.json",\n"vary": {\n"seed": "1-1000000"}}', "'vary.seed' has 1,000,000 values; the maximum is 100,000 runs"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"vary": {"seed": "1-1000", "fields.a": "1-1000"}}', "the experiment has 1,000,000 runs"),
    (4, '{"version": 1, "scenario": "scenario.json",\n"vary": {"fields.a":\n[1,\n{}]}}', "'vary.fields.a[1]' is {}; it must be a number"),
    (4, '{"version": 1, "scenario": "scenario.json",\n"vary": {"fields.a":\n[1,\n1.0]}}', "duplicate runs: 'fields.a=1' occurs twice"),
    (4, '{"version": 1, "scenario": "scenario.json",\n"vary": {"fields.a":\n[1,\n"1"]}}', "duplicate runs: 'fields.a=1' occurs twice"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"zip": {"fields.a": [1, 1], "fields.b": [2, 2]}}', "duplicate runs"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"vary": {"runtime": ["BuiltIn", "builtin"]}}', "duplicate runs: 'runtime=builtin' occurs twice"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"vary": {"fields.movement.kind": ["None", "none"]}}', "'fields.movement.kind=none' occurs twice"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"zip": {"fields.a": [1], "fields.b": [2, 2]}}', "these must be equal"),
    (3, '{"version": 1, "scenario": "scenario.json", "vary": {"seed": [1]},\n"set": {\n"seed": 2}}', "'seed' is also in 'vary'"),
    (3, '{"version": 1, "scenario": "scenario.json", "vary": {"seed": [1],\n\n"seed": [2]}}', "the key 'seed' is used twice"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"vary": {"scripts": ["a", "b"]}}', "'scripts' cannot vary"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"set": {"outputs.replay": true}}', "'outputs.replay' cannot be set in sweeps"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"measure": {"error": 3}}', "'measure' must be a list of metrics"),
    (2, '{"version": 1,\n;}', "not valid JSON: expected a key"),
    (2, '{"version": 1,\n"scenario": "\\ud800"}', "contains an unpaired surrogate"),
    (2, '{"version": 1,\n"set": {"a": ' + "7" * 5000 + "}}", "not valid JSON: a number has 5,000 characters"),
    (2, '{"version": 1,\n"set": {"a": 1e999}}', "not valid JSON: 1e999 is too large"),
    (2, '{"version": 1,\n"set": ' + "[" * 100_000, "not valid JSON: more than 64 levels"),
    (2, '{"version": 1, "scenario": "scenario.json",\n"vary": {"seed": "1-' + "9" * 5000 + '"}}', "is not a range"),
])
def test_errors_have_a_line(tmp_path: Path, line: int, text: str, message: str) -> None:
    with pytest.raises(ExperimentError) as error:
        read(write(tmp_path, text))
    assert f"experiment.json:{line}: " in str(error.value)
    assert message in str(error.value)


def test_all_combinations_are_run_and_keys_of_zip_vary_together(tmp_path: Path) -> None:
    experiment = read(write(tmp_path, json.dumps({
        "version": 1, "scenario": "scenario.json", "vary": {"program": ["a", "b"], "seed": "1-5:2"},
        "zip": {"fields.n": [1, 2], "fields.at": [[0, 1, 2], [3, 4, 5]]},
        "set": {"seconds": 3}})))
    runs = list(experiment.runs())
    assert experiment.count == len(runs) == 12
    assert runs[0].name.rpartition("-")[0] == "program=a,seed=1,fields.n=1,fields.at=0_1_2"
    assert runs[-1].settings == {"seconds": 3, "program": "b", "seed": 5, "fields.n": 2, "fields.at": [3, 4, 5]}


def test_an_object_does_not_replace_keys_in_it(tmp_path: Path) -> None:
    experiment = read(write(tmp_path, json.dumps({
        "version": 1, "scenario": "scenario.json", "vary": {"network.jitter": [1]}, "set": {"network.loss": 0.5, "network": {"delay": 1}}})))
    assert [list(run.settings) for run in experiment.runs()] == [["network", "network.loss", "network.jitter"]]


def test_a_key_cannot_be_the_convergence_time_of_another_metric(tmp_path: Path) -> None:
    (tmp_path / "scenario.json").write_text('{"converged": {"m": {"to": 1}, "m.to": {"to": 1}}}')
    file = tmp_path / "experiment.json"
    file.write_text('{"version": 1, "scenario": "scenario.json", "vary": {"converged.m.to": [1, 2]}}')
    with pytest.raises(ExperimentError, match=r"'converged\.m\.to' is also the name of a column"):
        _check_figures(read(str(file)), ["m", "m.to"])


def test_a_metric_cannot_be_the_convergence_time_of_another_metric(tmp_path: Path) -> None:
    path = write(tmp_path, '{"version": 1, "scenario": "scenario.json", "set": {"converged.m": {"to": 1}}}')
    with pytest.raises(ExperimentError, match=r"the metric 'converged\.m' has the name of a column"):
        _check_figures(read(path), ["m", "converged.m"])


def test_a_file_that_is_not_utf_8_is_a_one_line_error(tmp_path: Path) -> None:
    (tmp_path / "experiment.json").write_bytes(b'{"version": "\xff"}')
    with pytest.raises(ExperimentError, match="is not a JSON file: it is not UTF-8"):
        read(str(tmp_path / "experiment.json"))


def test_a_pipe_is_rejected_without_reading_it(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "experiment.json")
    with pytest.raises(ExperimentError, match="cannot be read: it is not a file"):
        read(str(tmp_path / "experiment.json"))


def test_files_are_read_as_the_player_reads_them(tmp_path: Path) -> None:
    text = "\ufeff{ // a comment\n version: 1, 'scenario': 'scenario.json', /* another */ \"vary\": {\"seed\": [1, 2,],}, }"
    experiment = read(write(tmp_path, text))
    assert experiment.product == [("seed", [1, 2])]


def test_the_scenario_in_a_folder_above_a_symbolic_link_is_the_one_that_the_player_reads(tmp_path: Path) -> None:
    (tmp_path / "elsewhere/deep").mkdir(parents=True)
    (tmp_path / "link").symlink_to("elsewhere/deep")
    for folder in (tmp_path, tmp_path / "elsewhere"):
        (folder / "scenario.json").write_text("{}")
    (tmp_path / "link/experiment.json").write_text('{"version": 1, "scenario": "../scenario.json"}')
    assert read(str(tmp_path / "link/experiment.json")).scenario.path == str(tmp_path / "scenario.json")


def named(values: dict[str, object]) -> str:
    return name_of(values, values)


def test_any_value_gives_a_valid_folder_name() -> None:
    assert named({"fields.title": "a/b c.\n", "fields.on": True}).rpartition("-")[0] == "fields.title=a_b_c._,fields.on=true"
    assert len(named({f"fields.{'x' * 1000}": 1})) < 180
    assert "/" not in named({"../../x": "../../y"})


@pytest.mark.parametrize(("one", "other"), [
    ({"a": "1,b=2"}, {"a": "1", "b": "2"}),
    ({"a": "x/y"}, {"a": "x_y"}),
    ({"a": 1}, {"a": True}),
    ({"a": "1"}, {"a": 1}),
    ({"a": [1, 2]}, {"a": "1_2"}),
    ({"a": 0.0}, {"a": -0.0}),
    ({"a" * 200: 1}, {"a" * 200: 2}),
    ({"a": "x"}, {"a": "x.part"}),
])
def test_two_configurations_never_share_a_folder(one: dict[str, object], other: dict[str, object]) -> None:
    assert named(one) != named(other)
    # A name must not be a prefix of another one, because the folder of an unfinished run has a suffix after the name.
    assert not named(other).startswith(named(one))


def test_the_order_of_settings_does_not_change_the_folder() -> None:
    assert name_of({"a": 1}, {"a": 1, "b": 2.0}) == name_of({"a": 1}, {"b": 2, "a": 1.0})


@pytest.mark.parametrize("text", [" " * 300_000 + "{}", '"' + "a" * 300_000 + '"', "'" + "a" * 300_000 + "'"])
def test_reading_a_large_file_needs_little_memory(tmp_path: Path, text: str) -> None:
    path = tmp_path / "large.json"
    path.write_text(text)
    tracemalloc.start()
    try:
        Located(str(path))
        assert tracemalloc.get_traced_memory()[1] < 10 * len(text)
    finally:
        tracemalloc.stop()


def test_values_of_a_column_stay_different() -> None:
    large = 2 ** 53
    for values in [large, large + 1, 0.5], [-1, 2 ** 63, 2 ** 63 + 1], [2 ** 64, 2 ** 64 + 1]:
        column = pa.array([_value(value, _type_of(values)) for value in values], _type_of(values))
        assert len(column.unique()) == len(values)
    assert _type_of([large, 0.5]) == pa.float64()


def test_a_sweep_starts_without_the_packages_for_figures() -> None:
    code = "import sys, collektive_experiments.__main__; print({'matplotlib', 'pandas'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True).stdout == "set()\n"


@pytest.mark.parametrize(("option", "maximum"), [("--jobs", "10,000"), ("--time-limit", "1,000,000,000"), ("--trials", "1,000,000,000")])
def test_numbers_that_are_too_large_are_a_one_line_error(option: str, maximum: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["tune", "experiment.json", option, "9999999999"])
    assert capsys.readouterr().err == (
        f"collektive: tune: argument {option}: '9999999999' is not a whole number from 1 to {maximum} (see ./collektive tune --help)\n")
