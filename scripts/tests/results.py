"""Adds up the JUnit XML results of suites."""
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from build.console import print_progress
from tests import junit


def read(folder: Path, failure: str) -> list[junit.Case]:
    """Returns the tests that a suite has run, by the files in its folder.

    A suite that wrote no whole results is a failure, and so is one that failed, by `failure`, although no test did. With notes it may have run no
    test.
    """
    cases, broken = [], []
    for path in sorted(folder.glob("*.xml")):
        try:
            cases += junit.read(str(path))
        except ValueError as error:
            broken.append(junit.Case(path.name, str(error)))
    if not broken and not cases and (failure or not notes(folder)):
        broken.append(junit.Case("results", f"the suite wrote no results: {failure or 'it passed'}"))
    if not broken and failure and not any(case.failure for case in cases):
        broken.append(junit.Case("end", f"the suite failed although no test did: {failure}"))
    return cases + broken


def notes(folder: Path) -> str:
    """Returns the suite's notes, such as what it could not run and why."""
    file = folder / "notes"
    return file.read_text() if file.exists() else ""


def verdict(suites: Mapping[str, Sequence[junit.Case]], folder: Path, skipped: int = 0) -> int:
    """Prints failed tests, notes and totals, and returns the exit code."""
    for name, cases in suites.items():
        for case in cases:
            if case.failure:
                print(f"FAILED {name}: {case.name}: {case.failure.splitlines()[0][:200]}", file=sys.stderr)
        sys.stderr.write(notes(folder / name))
        failed = sum(bool(case.failure) for case in cases)
        print_progress(f"test {name}: {len(cases) - failed} passed, {failed} failed")
    every = [case for cases in suites.values() for case in cases]
    failed = sum(bool(case.failure) for case in every)
    print(f"{len(every) - failed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed else 0
