"""Runs the fuzzer of experiments for a short time, and tests sweeps in which a single call fails."""
import random
from pathlib import Path

import pytest
from fuzz import Case, fuzz, try_fault


def test_random_experiments_give_the_rows_of_the_model(tmp_path: Path) -> None:
    messages: list[str] = []
    assert fuzz(8, 1, tmp_path, messages.append) == 0, "\n".join(messages)


@pytest.mark.parametrize("at", [9, *(pytest.param(at, marks=pytest.mark.slow) for at in (1, 30, 60, 90, 10_000))])
def test_after_a_failing_system_call_each_folder_is_complete_or_marked_or_absent(tmp_path: Path, at: int) -> None:
    case = Case(random.Random(at))
    case.root |= {"vary": {"seed": [1, 2]}, "zip": {}, "set": {"fields.names": "one"}, "measure": ["one"]}
    calls = try_fault(case, tmp_path, at)
    assert 100 < calls < 10_000 or at < 10_000
