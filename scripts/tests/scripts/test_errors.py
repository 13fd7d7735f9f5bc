"""Tests that the site's page of errors lists all errors with their meanings and solutions."""
import re

from build.site import errors
from build.site.sources import text


def test_each_error_code_of_the_header_has_a_solution() -> None:
    assert [name for name, *_ in errors.codes()] == list(errors.SOLUTIONS)


def test_the_error_codes_of_csharp_match_the_header() -> None:
    named = {number: name.replace("_", "").lower() for name, number, _ in errors.codes()}
    assert {number: name.lower() for number, name in errors.bridge_errors().items()} == named
    assert len(named) == len(re.findall(r"(?m)^ +\w+ = -", text("unity/Runtime/Bridge/BridgeException.cs")))


def test_each_check_of_the_compiler_plugin_documents_condition_and_solution() -> None:
    found = {name: doc for name, _, doc in errors.checks()}
    source = text("jvm-host/compiler-plugin/src/main/kotlin/org/collektive/compiler/checks/AggregateDiagnostics.kt")
    assert sorted(found) == sorted(re.findall(r"\bval ([A-Z_]{4,}) by ", source))
    assert [name for name, doc in found.items() if doc.count(". ") < 1] == []


def test_each_exit_code_has_a_meaning() -> None:
    found = dict(errors.exit_codes())
    # These commands have more exit codes than 0 and 1.
    assert {"", "run", "repeat", "sweep", "replay", "diff"} <= found.keys()
    assert [meaning for meanings in found.values() for meaning in meanings if not re.match(r"(\d+|any) \S", meaning)] == []


def test_the_page_lists_all_errors() -> None:
    page = errors.errors()
    shown = re.findall(r"(?m)^\| .*", page)
    assert page.count("| next tick |") > 20
    for name in [*(f"CLK_{name}" for name in errors.SOLUTIONS), *errors.bridge_errors().values(), *(name for name, *_ in errors.checks()), "replay"]:
        assert any(f"`{name}`" in row for row in shown), name
