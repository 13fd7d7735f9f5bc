"""Reads and writes test results in JUnit XML."""
import itertools
import os
import re
from collections.abc import Iterable
from dataclasses import dataclass
from xml.etree.ElementTree import ParseError

from junitparser import Attr, Failure, JUnitXml, JUnitXmlError, Skipped, TestCase, TestSuite


@dataclass(frozen=True)
class Case:
    """A test that ran. It passed if its failure is empty."""
    name: str
    failure: str = ""
    seconds: float = 0


class _Case(TestCase):
    status = Attr()
    """The status that CTest writes for a test: `run`, or the kind of failure."""


class _Suite(TestSuite):
    testcase = _Case


class _Results(JUnitXml):
    testsuite = _Suite


def read(path: str) -> list[Case]:
    """Returns the tests in a file, except the skipped ones. Raises ValueError if the file contains no results."""
    try:
        results = _Results.fromfile(path)
        # Tests may also be outside a suite, because Node's reporter writes such tests.
        tests: Iterable[_Case] = itertools.chain(results.iterchildren(_Case), *results)  # type: ignore[no-untyped-call]
        return [_case(test) for test in tests if not _skipped(test)]
    except (OSError, ParseError, JUnitXmlError, ValueError) as error:
        raise ValueError(f"{path} cannot be read: {error}") from error


def read_skipped(path: str) -> dict[str, str]:
    """Returns the skipped tests in a file that CTest has written, each with the reason in its output."""
    reasons = {}
    for test in itertools.chain(*_Results.fromfile(path)):
        if _skipped(test):
            reason = re.search(r"SKIPPED: (.*)", test.system_out or "")
            reasons[str(test.name)] = reason[1] if reason else "it gave no reason"
    return reasons


def _skipped(test: _Case) -> bool:
    """Returns whether a test was skipped. A missing program is a failure, although CTest reports it as skipped, too."""
    return any(isinstance(result, Skipped) and not (result.message or "").startswith("Unable to find executable") for result in test.result)


def _case(test: _Case) -> Case:
    name = ".".join(part for part in (test.classname, test.name) if part)
    failures = [result for result in test.result if not isinstance(result, Skipped)]
    # If the program of a test is missing, only the status of the test shows that it failed.
    if not failures and test.status in (None, "run"):
        return Case(name, "", test.time or 0)
    text = failures[0].message or failures[0].text or "" if failures else ""
    return Case(name, text.strip() or "failed", test.time or 0)


def write(path: str, name: str, cases: list[Case]) -> None:
    """Writes the results of a suite atomically."""
    tests = []
    for case in cases:
        test = TestCase(case.name, name, case.seconds)
        if case.failure:
            failure = Failure(_printable(case.failure.splitlines()[0]))
            failure.text = _printable(case.failure)
            test.result = failure
        tests.append(test)
    suite = TestSuite(name)
    suite.add_testcases(tests)
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    suite.write(path + ".part")
    os.replace(path + ".part", path)


def report(path: str | None, name: str, cases: list[Case]) -> int:
    """Prints how many tests passed and failed, writes the results if a path is given, and returns the exit code."""
    failed = sum(bool(case.failure) for case in cases)
    print(f"{len(cases) - failed} passed, {failed} failed")
    if path:
        write(path, name, cases)
    return int(failed > 0)


def _printable(text: str) -> str:
    """Replaces control characters, which XML does not allow."""
    return "".join(character if character in "\n\t" or character >= " " else "?" for character in text)
