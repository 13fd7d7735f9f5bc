"""Tests the check of commit subjects."""
import subprocess
import sys
from pathlib import Path

import commits
import pytest

from build.places import ROOT


@pytest.mark.parametrize("subject", ["Report repeated sensor errors once", "Address review", "Process links in order", "Merge branch 'x'", "Focus the view",
                                     "Fix " + "x" * 68])
def test_imperative_subjects_of_at_most_72_characters_pass(subject: str) -> None:
    assert commits.problem(subject) is None


@pytest.mark.parametrize("subject", ["Reports errors once", "Reported errors once", "Reporting errors once", "report errors once", "Report errors once.",
                                     "Wording", "Sensors that fail are told once", "Fix " + "x" * 69])
def test_other_subjects_are_refused(subject: str) -> None:
    assert commits.problem(subject) is not None


def test_each_commit_since_the_base_is_checked(tmp_path: Path) -> None:
    def git(*arguments: str) -> None:
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *arguments], cwd=tmp_path, check=True, capture_output=True)

    git("init", "--initial-branch=main")
    for subject in ("Before the base, unchecked.", "Add a page", "Added a page"):
        git("commit", "--allow-empty", "--message", subject)
    result = subprocess.run([sys.executable, "-I", ROOT / "scripts/checks/commits.py", "HEAD~2"], cwd=tmp_path, capture_output=True, text=True)
    assert result.returncode == 1
    assert len(result.stderr.splitlines()) == 1 and "Added a page" in result.stderr
