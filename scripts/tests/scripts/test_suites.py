"""Tests how `./collektive test` reports suites that pass, fail, hang or crash."""
import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from checkout import Checkout

from build import graph, inputs, player, project_tests
from build.console import Failure
from build.places import COLLEKTIVE, ROOT
from commands import test as command
from commands.check import SCENARIO
from commands.test import Suite
from tests import junit, results

GOOD = '<testsuite><testcase classname="a" name="one"/><testcase classname="a" name="two"/></testsuite>'
BAD = '<testsuites><testsuite><testcase name="one"/><testcase name="two"><failure message="no">at line 3</failure></testcase></testsuite></testsuites>'
PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(it NONE)
enable_testing()
set(COLLEKTIVE_BUILD "${PROJECT_SOURCE_DIR}/build")
set(COLLEKTIVE_PYTHON "%s")
include(cmake/Suite.cmake)
suite(good it LABELS all NEEDS setup:thing COMMAND cp good.xml RESULTS/results.xml)
suite(bad it LABELS quick all COMMAND sh -c "cp bad.xml \\"$1\\" && exit 1" sh RESULTS/results.xml)
suite(without-fixture it LABELS all NEEDS build:broken COMMAND cp good.xml RESULTS/results.xml)
suite(endless it LABELS extra TIMEOUT 2 COMMAND sh -c "sleep 613 & sleep 613")
suite(crash it LABELS extra COMMAND sh -c "cp good.xml \\"$1\\" && kill -SEGV $$" sh RESULTS/results.xml)
suite(missing it LABELS extra COMMAND nonesuch)
suite(needs-nunit it LABELS all NUNIT COMMAND cp good.xml RESULTS/results.xml)
"""


def counts(cases: list[junit.Case]) -> tuple[int, int]:
    """Returns the numbers of passed and failed tests."""
    failed = sum(bool(case.failure) for case in cases)
    return len(cases) - failed, failed


@pytest.mark.parametrize("files, failure, expected", [
    ({"results.xml": GOOD}, "", (2, 0)),
    ({"results.xml": BAD}, "Failed", (1, 1)),
    ({"results.xml": GOOD, "more.xml": BAD}, "Failed", (3, 1)),
], ids=["all pass", "one fails", "two files"])
def test_the_results_file_of_a_suite_determines_its_counts(tmp_path: Path, files: dict[str, str], failure: str, expected: tuple[int, int]) -> None:
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert counts(results.read(tmp_path, failure)) == expected


@pytest.mark.parametrize("files, failure, expected", [
    ({}, "", (0, 1)),
    ({}, "Failed", (0, 1)),
    ({"results.xml": GOOD}, "Timeout", (2, 1)),
    ({"results.xml": GOOD, "cut.xml": "<testsuite><testca"}, "", (2, 1)),
    ({"results.xml": "<html/>"}, "", (0, 1)),
    ({"results.xml": "<testsuite/>"}, "", (0, 1)),
    ({"output": "7 passed, 0 failed"}, "", (0, 1)),
], ids=["no file", "no file and a failure", "failure after its results", "file cut short", "file of something else", "no test", "only a line"])
def test_a_suite_with_incomplete_results_or_an_abnormal_end_fails(tmp_path: Path, files: dict[str, str], failure: str,
                                                                       expected: tuple[int, int]) -> None:
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert counts(results.read(tmp_path, failure)) == expected


def test_a_suite_without_tests_reports_the_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "it").mkdir()
    (tmp_path / "it/notes").write_text("no emulator\n")
    assert results.read(tmp_path / "it", "") == []
    assert results.verdict({"it": []}, tmp_path) == 0
    assert "no emulator" in capsys.readouterr().err
    assert counts(results.read(tmp_path / "it", "Failed")) == (0, 1)


def test_failed_tests_are_listed_and_the_last_line_is_the_total(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert results.verdict({"it": [junit.Case("one"), junit.Case("two", "no\nat line 3")], "other": [junit.Case("three")]}, tmp_path) == 1
    output = capsys.readouterr()
    assert "FAILED it: two: no\n" in output.err
    assert output.out == "2 passed, 1 failed\n"
    assert results.verdict({"it": [junit.Case("one")]}, tmp_path, skipped=2) == 0
    assert capsys.readouterr().out == "1 passed, 0 failed, 2 skipped\n"


def test_skipped_tests_do_not_count(tmp_path: Path) -> None:
    path = tmp_path / "results.xml"
    path.write_text('<testsuite><testcase name="one"><skipped/></testcase><testcase name="two"/></testsuite>')
    assert [case.name for case in junit.read(str(path))] == ["two"]


def test_tests_without_a_suite_count(tmp_path: Path) -> None:
    path = tmp_path / "results.xml"
    path.write_text('<testsuites><testcase name="one"/><testsuite><testsuite><testcase name="two"/></testsuite></testsuite></testsuites>')
    assert [case.name for case in junit.read(str(path))] == ["one", "two"]


def test_written_results_can_be_read_back(tmp_path: Path) -> None:
    cases = [junit.Case("it's <fine>"), junit.Case("it is not", "because \x1b[31m& more\nlines", 1.5)]
    path = str(tmp_path / "new" / "results.xml")
    junit.write(path, "suite", cases)
    good, bad = junit.read(path)
    assert (good.name, good.failure) == ("suite.it's <fine>", "")
    assert (bad.failure, bad.seconds) == ("because ?[31m& more", 1.5)


def test_the_results_of_ctest_are_read(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(textwrap.dedent("""\
        cmake_minimum_required(VERSION 3.25)
        project(it NONE)
        enable_testing()
        add_test(NAME good COMMAND true)
        add_test(NAME bad COMMAND false)
        add_test(NAME crash COMMAND sh -c "kill -SEGV $$")
        add_test(NAME missing COMMAND nonesuch)
        """))
    subprocess.run(["cmake", "-G", "Ninja", "-S", tmp_path, "-B", tmp_path], check=True, capture_output=True)
    subprocess.run(["ctest", "--test-dir", tmp_path, "--output-junit", tmp_path / "results.xml"], capture_output=True)
    assert {case.name.split(".")[-1]: bool(case.failure) for case in junit.read(str(tmp_path / "results.xml"))} == {
        "good": False, "bad": True, "crash": True, "missing": True}


def test_projects_whose_scenarios_have_the_same_name_have_separate_results(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def run(project: Path, folder: Path) -> int:
        folder.mkdir(parents=True, exist_ok=True)
        is_bad = project.parent.name == "a"
        (folder / "results.xml").write_text(BAD if is_bad else GOOD)
        return int(is_bad)

    monkeypatch.setattr(graph, "build", lambda *_: None)
    monkeypatch.setattr(command, "setup_environment", lambda: None)
    monkeypatch.setattr(project_tests, "run", run)
    monkeypatch.setattr(command, "RESULTS", tmp_path / "results")
    assert command.test_projects([tmp_path / "a/scenario.json", tmp_path / "b/scenario.json"]) == 1
    assert capsys.readouterr().out == "3 passed, 1 failed\n"


def test_a_project_in_the_folder_of_the_checkout_is_not_a_suite(checkout: Checkout, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "ROOT", checkout.root)
    monkeypatch.chdir(checkout.root)
    for name in ("herd", "bench"):
        Path(name).mkdir()
    Path("herd/scenario.json").touch()
    assert [command.is_project(word) for word in ("herd", "bench", "lint")] == [True, False, False]


def test_folders_of_programs_with_the_same_content_have_separate_tests(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
    plans = {f"{name}.json": player.Plan({}, {"programs": inputs.programs(tmp_path / name[0])}) for name in ("a", "a-too", "b")}
    tested = []

    def run(scenario: Path, *_: object) -> int:
        tested.append(scenario.name)
        return 0

    monkeypatch.setattr(project_tests, "find_files", lambda _: [(Path(name), SCENARIO) for name in plans])
    monkeypatch.setattr(player, "plan", lambda scenario, _: plans[scenario])
    monkeypatch.setattr(project_tests, "_run", run)
    assert project_tests.run(tmp_path, tmp_path / "results") == 0
    assert tested == ["a.json", "b.json"]


@pytest.fixture
def project(checkout: Checkout, monkeypatch: pytest.MonkeyPatch) -> Callable[..., dict[str, tuple[int, int]]]:
    """A function that runs suites of a small project. It returns the numbers of passed and failed tests of each suite."""
    root = checkout.root
    (root / "CMakeLists.txt").write_text(PROJECT % sys.executable)
    (root / "cmake").mkdir()
    (root / "cmake/Suite.cmake").write_text((ROOT / "cmake/Suite.cmake").read_text())
    (root / "collektive").write_text("#!/bin/sh\ntest $2 != broken\n")
    (root / "good.xml").write_text(GOOD)
    (root / "bad.xml").write_text(BAD)
    subprocess.run(["cmake", "-G", "Ninja", "-S", root, "-B", root / "build/cmake"], check=True, capture_output=True)
    monkeypatch.setattr(command, "GRAPH", root / "build/cmake")
    monkeypatch.setattr(command, "RESULTS", root / "build/results")

    def run(*names: str) -> dict[str, tuple[int, int]]:
        failures = command.run_suites(names)
        return {name: counts(results.read(root / "build/results" / name, failures.get(name, "did not run"))) for name in names}
    return run


def test_suites_run_with_their_fixtures_and_within_their_time(project: Callable[..., dict[str, tuple[int, int]]]) -> None:
    assert project("good", "bad", "without-fixture") == {"good": (2, 0), "bad": (1, 1), "without-fixture": (0, 1)}
    assert project("endless", "crash", "missing") == {"endless": (0, 1), "crash": (2, 1), "missing": (0, 1)}
    # After the time limit, no process of the suite may be left.
    assert subprocess.run(["pgrep", "-fx", "sleep 613"], stdout=subprocess.PIPE, text=True).stdout == ""


def test_the_suites_of_a_project_are_found_with_their_labels_and_targets(project: Callable[..., dict[str, tuple[int, int]]]) -> None:
    suites = {suite.name: suite for suite in command.read_suites()}
    assert set(suites) == {"good", "bad", "without-fixture", "endless", "crash", "missing", "needs-nunit"}
    assert suites["bad"] == Suite("bad", frozenset({"it", "quick", "all"}))
    assert suites["needs-nunit"].is_disabled
    assert suites["without-fixture"].targets == {"broken"}


SUITES = [Suite("lint", frozenset({"lint", "quick", "all"})), Suite("jvm", frozenset({"jvm", "all"})), Suite("jvm-quick", frozenset({"jvm", "quick"})),
          Suite("unity", frozenset({"csharp", "quick", "all"})), Suite("csharp-on-17", frozenset({"csharp", "all"})),
          Suite("csharp-slow-on-17", frozenset({"csharp", "extra"})), Suite("sanitized-on-17", frozenset({"sanitized", "extra"}))]


@pytest.mark.parametrize("words, names", [
    (["all"], ["lint", "jvm", "unity", "csharp-on-17"]),
    (["quick"], ["lint", "jvm-quick", "unity"]),
    (["csharp", "lint"], ["lint", "unity", "csharp-on-17"]),
    (["jvm"], ["jvm"]),
    (["csharp-slow-on-17", "jvm-quick"], ["jvm-quick", "csharp-slow-on-17"]),
    (["sanitized"], ["sanitized-on-17"]),
])
def test_suites_are_chosen_by_run_area_and_name(words: list[str], names: list[str]) -> None:
    assert [suite.name for suite in command.select_suites(SUITES, words)] == names


def test_an_unknown_suite_is_reported_with_the_known_ones() -> None:
    with pytest.raises(Failure, match="unknown suite 'nonesuch'; known: areas lint jvm csharp sanitized; suites csharp-on-17 "):
        command.select_suites(SUITES, ["lint", "nonesuch"])


def test_suites_without_nunit_are_skipped_or_an_error_if_all_are(capsys: pytest.CaptureFixture[str]) -> None:
    suites = [*SUITES[:1], *(suite._replace(is_disabled=True) for suite in SUITES[3:5])]
    assert [suite.name for suite in command.select_suites(suites, ["all"])] == ["lint"]
    assert "skipped unity, csharp-on-17: this system has no package for NUnit 2.6" in capsys.readouterr().err
    with pytest.raises(Failure, match="no package for NUnit"):
        command.select_suites(suites, ["csharp"])


@pytest.fixture(scope="module")
def declared() -> list[Suite]:
    """Returns the suites of this checkout. The build graph is configured, because the suite `scripts` needs it."""
    return command.read_suites()


def test_no_suite_is_a_project(declared: list[Suite], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert [suite.name for suite in declared if command.is_project(suite.name)] == []


def test_a_quick_run_has_most_suites_on_one_jdk(declared: list[Suite]) -> None:
    names = [suite.name for suite in command.select_suites(declared, ["quick"])]
    assert {"lint", "scripts", "jvm-quick", "assets", "acceptance-quick"} <= set(names)
    assert len([name for name in names if name.startswith("shim-on-")]) == 1
    assert not {"acceptance-rest", "page", "bench", "exits", "jvm"} & set(names)


def test_a_whole_run_has_every_suite_of_a_quick_one(declared: list[Suite]) -> None:
    quick, whole = ({suite.name for suite in command.select_suites(declared, [run])} for run in ("quick", "all"))
    assert quick - whole == {"jvm-quick"}


def test_each_area_is_described_in_the_help(declared: list[Suite]) -> None:
    text = subprocess.run([COLLEKTIVE, "test", "--help"], capture_output=True, text=True, check=True).stdout
    areas = {area for suite in declared for area in suite.labels - command.RUNS}
    assert areas >= {"lint", "scripts", "jvm", "stress", "shim", "platforms", "csharp", "assets", "faults", "exits", "soak", "roundtrip", "page", "site",
                     "acceptance", "experiments", "chaos", "fuzz", "bench", "gradle"}
    assert [area for area in areas if area.removesuffix("d") not in text] == []
