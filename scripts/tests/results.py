"""Reads and summarises the JUnit XML results of suites."""
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from build.console import print_progress
from tests import junit


def read(folder: Path, failure: str) -> list[junit.Case]:
    """Returns the tests that a suite has run, according to the files in its folder. `failure` is the reason why the suite failed, or empty.

    A failed test is added if the results are missing or damaged, or if the suite failed although all tests passed. Results may be missing if the suite
    passed and wrote notes.
    """
    cases, broken = [], []
    for path in sorted(folder.glob("*.xml")):
        try:
            cases += junit.read(str(path))
        except ValueError as error:
            broken.append(junit.Case(path.name, str(error)))
    if not broken and not cases and (failure or not notes(folder)):
        broken.append(junit.Case("results", f"the suite wrote no results: {failure or 'its command succeeded'}"))
    if not broken and failure and not any(case.failure for case in cases):
        broken.append(junit.Case("end", f"the suite failed although no test did: {failure}"))
    return cases + broken


def notes(folder: Path) -> str:
    """Returns the suite's notes, for example about tests that it could not run."""
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
