"""What ./collektive test makes of suites that end in all ways."""
import os
import subprocess
import textwrap

import junit
import pytest
import suites

GOOD = '<testsuite><testcase classname="a" name="one"/><testcase classname="a" name="two"/></testsuite>'
BAD = '<testsuites><testsuite><testcase name="one"/><testcase name="two"><failure message="no">at line 3</failure></testcase></testsuite></testsuites>'


@pytest.fixture
def outcome(tmp_path, monkeypatch, capsys):
    """Runs a suite whose step is a shell script; returns how many tests passed and failed, and the output."""
    def of(script):
        command = tmp_path / "collektive"
        command.write_text("#!/bin/bash\n# Called with: step test_it FOLDER\nset -e\nfolder=$3\n" + script)
        command.chmod(0o755)
        monkeypatch.setattr(suites, "COLLEKTIVE", str(command))
        cases = suites.run(suites.Suite("it", ["test_it"]), str(tmp_path / "build"))
        failed = sum(bool(case.failure) for case in cases)
        return len(cases) - failed, failed, capsys.readouterr().err
    return of


def written(text, name="results.xml"):
    return f"cat >$folder/{name} <<'E'\n{text}\nE\n"


@pytest.mark.parametrize("script, passed, failed", [
    (written(GOOD), 2, 0),
    (written(BAD) + "exit 1", 1, 1),
    (written(GOOD) + written(BAD, "more.xml") + "exit 1", 3, 1),
], ids=["all pass", "one fails", "two files"])
def test_a_suite_counts_by_the_results_that_it_wrote(outcome, script, passed, failed):
    assert outcome(script)[:2] == (passed, failed)


@pytest.mark.parametrize("script, passed, failed", [
    ("true", 0, 1),
    ("exit 1", 0, 1),
    ("kill -SEGV $$", 0, 1),
    (written(GOOD) + "exit 134", 2, 1),
    (written(GOOD) + written("<testsuite><testca", "cut.xml"), 2, 1),
    (written("<html/>"), 0, 1),
    (written("<testsuite/>"), 0, 1),
    ("echo '7 passed, 0 failed'", 0, 1),
], ids=["no file", "no file and a code", "crash", "crash after its results", "file cut short", "file of something else", "no test", "only a line"])
def test_a_suite_without_whole_results_or_with_a_bad_end_is_a_failure(outcome, script, passed, failed):
    assert outcome(script)[:2] == (passed, failed)


def test_a_suite_that_could_run_nothing_says_why(outcome):
    passed, failed, output = outcome("echo 'no emulator' >$folder/notes")
    assert (passed, failed) == (0, 0) and "no emulator" in output
    assert outcome("echo 'no emulator' >$folder/notes; exit 1")[:2] == (0, 1)


def test_results_of_an_earlier_run_do_not_count(outcome):
    outcome(written(GOOD))
    assert outcome("true")[:2] == (0, 1)


def test_what_failed_is_named(outcome):
    output = outcome(written(BAD) + "echo some output; exit 1")[2]
    assert "FAILED it: two: no" in output
    assert "some output" in output


def test_skipped_tests_do_not_count(tmp_path):
    path = tmp_path / "results.xml"
    path.write_text('<testsuite><testcase name="one"><skipped/></testcase><testcase name="two"/></testsuite>')
    assert [case.name for case in junit.read(str(path))] == ["two"]


def test_tests_without_a_suite_count(tmp_path):
    path = tmp_path / "results.xml"
    path.write_text('<testsuites><testcase name="one"/><testsuite><testsuite><testcase name="two"/></testsuite></testsuite></testsuites>')
    assert [case.name for case in junit.read(str(path))] == ["one", "two"]


def test_what_is_written_can_be_read(tmp_path):
    cases = [junit.Case("it's <fine>"), junit.Case("it is not", "because \x1b[31m& more\nlines", 1.5)]
    path = str(tmp_path / "new" / "results.xml")
    junit.write(path, "suite", cases)
    good, bad = junit.read(path)
    assert (good.name, good.failure) == ("suite.it's <fine>", "")
    assert (bad.failure, bad.seconds) == ("because ?[31m& more", 1.5)


def test_the_results_of_ctest_are_read(tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(textwrap.dedent("""\
        cmake_minimum_required(VERSION 3.25)
        project(it NONE)
        enable_testing()
        add_test(NAME good COMMAND true)
        add_test(NAME bad COMMAND false)
        add_test(NAME crash COMMAND sh -c "kill -SEGV $$")
        add_test(NAME missing COMMAND nonesuch)
        """))
    subprocess.run(["cmake", "-S", tmp_path, "-B", tmp_path], check=True, capture_output=True)
    subprocess.run(["ctest", "--test-dir", tmp_path, "--output-junit", tmp_path / "results.xml"], capture_output=True)
    assert {case.name.split(".")[-1]: bool(case.failure) for case in junit.read(str(tmp_path / "results.xml"))} == {
        "good": False, "bad": True, "crash": True, "missing": True}


def test_suites_are_chosen_by_name():
    known = suites.all_suites(["/jvm/17", "/jvm/25"])
    titles = [suite.title for suite in suites.chosen(known, ["shim", "csharp"])]
    assert titles == ["shim-on-17", "shim-on-25", "unity", "csharp-on-17", "csharp-on-25", "csharp-on-coreclr"]
    with pytest.raises(ValueError, match="unknown suite 'nonesuch'; known: lint "):
        suites.chosen(known, ["nonesuch"])


def test_each_suite_can_be_named_before_the_jdks_are_known():
    for name in {suite.name for suite in suites.all_suites(["/jvm/17"])} - {"quick"}:
        suites.check_names([name])
    with pytest.raises(ValueError):
        suites.check_names(["nosuch"])


def test_a_quick_run_has_most_suites_on_one_jdk():
    titles = [suite.title for suite in suites.chosen(suites.all_suites(["/jvm/17", "/jvm/25"]), ["--quick"])]
    assert {"lint", "jvm", "shim-on-25", "csharp-on-25", "assets", "acceptance-quick"} <= set(titles)
    assert not {"shim-on-17", "csharp-on-17", "acceptance", "page", "bench", "exits"} & set(titles)


def test_a_whole_run_has_every_suite_but_the_short_acceptance():
    known = suites.all_suites(["/jvm/17"])
    assert [suite.name for suite in known if suite not in suites.chosen(known, [])] == ["quick"]


def test_each_suite_is_described_in_the_help():
    text = subprocess.run([suites.COLLEKTIVE, "test", "--help"], capture_output=True, text=True, check=True).stdout
    for suite in suites.chosen(suites.all_suites(["/jvm/17"]), []):
        assert suite.name in text


def test_each_step_of_a_suite_exists():
    for suite in suites.all_suites(["/jvm/17"]):
        for function in [suite.step[0], *suite.needs]:
            assert suites.step("declare", "-F", function, stdout=subprocess.PIPE).returncode == 0, function
    assert os.access(suites.COLLEKTIVE, os.X_OK)
