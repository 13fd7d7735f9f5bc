"""Runs each lesson, and checks the statements in its text."""
import csv
import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from command import collektive

from build.places import ROOT
from live import examples

LESSONS = ROOT / "scripts/lessons"
Row = dict[str, float]
# The statements of each lesson about the metrics at some seconds.
CLAIMS: dict[str, dict[float, Callable[[Row], bool]]] = {
    "gradient": {5: lambda row: row["wrong"] == 0 and row["farthest"] == 18},
    "channel": {5: lambda row: row["members"] == 10 and row["outside"] == 0},
    "leader": {5: lambda row: row["leaders"] == 1 and row["known"] == 100},
    "collection": {10: lambda row: row["counted"] == row["nodes"] == 100},
    "gossip": {4: lambda row: row["now"] == row["ever"] == 100, 12: lambda row: row["now"] == 20 and row["ever"] == 100},
    "healing": {5: lambda row: row["before"] == 0 and row["after"] > 0, 12: lambda row: row["after"] == 0},
    "sparse": {10: lambda row: row["leaders"] > 1 and row["farthest"] <= 10},
    "flocking": {1: lambda row: row["order"] < 1, 20: lambda row: row["order"] > 0.99},
}


@pytest.mark.parametrize("name", [
    pytest.param(name, marks=[pytest.mark.slow] * (name != "healing")) for name in sorted(os.listdir(LESSONS))])
def test_a_lesson_does_what_its_text_claims(name: str, tmp_path: Path) -> None:
    (program,) = (LESSONS / name / "programs").glob("*.kt")
    text = program.read_text().split("\npackage ")[0]
    assert text.startswith("// ") and "// Question: " in text
    result = collektive("run", LESSONS / name / "scenario.json", "--out", tmp_path / "out")
    assert result.returncode == 0, result.stderr
    with (tmp_path / "out/metrics.csv").open() as file:
        rows = {float(row["second"]): {key: float(value) for key, value in row.items()} for row in csv.DictReader(file)}
    for second, is_true in CLAIMS[name].items():
        assert is_true(rows[second]), (second, rows[second])
    assert json.loads((tmp_path / "out/manifest.json").read_text())["errors"] == 0


def test_the_live_page_offers_all_lessons() -> None:
    catalogue = examples.catalogue()
    assert sorted(examples.LESSONS) == sorted(os.listdir(LESSONS))
    assert all(examples.find(example["name"]) and example["title"] and example["text"].endswith(".") for example in catalogue)
    assert all(example["question"] for example in catalogue if example["name"] in examples.LESSONS)
