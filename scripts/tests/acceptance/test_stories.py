"""Follows the tutorials: writes their files, runs their commands, and compares the output with the page.

A block with a title is a file in the reader's project, which a later block with the same title replaces. The lines of a block `sh` are commands. A block
`text` after such a block shows lines of the output in order, where `...` matches any text.
"""
import os
import re
import shutil
import subprocess
import tempfile

import pytest
import replay
from blocks import STORIES, blocks
from command import WORK

from build.places import ROOT

# Other tests cover debugging, profiling and scene builders.
SLOW = ("first-study", "tutorial-debugging", "tutorial-experiment", "tutorial-from-collektive", "tutorial-own-parts", "tutorial-own-rule",
        "tutorial-profiling", "tutorial-scene-builder")
# These commands exit with 1 if two runs differ, which is not an error in a tutorial.
COMPARE = ("collektive diff ", "collektive replay ")


def missing(shown, printed):
    """Returns the first expected line that is missing in the output, or None if all lines are present."""
    at = 0
    for line in filter(None, map(str.strip, shown.splitlines())):
        found = re.compile(re.escape(line).replace(r"\.\.\.", ".*")).search(printed, at)
        if line != "..." and not found:
            return line
        at = found.end() if line != "..." else at
    return None


@pytest.fixture
def folder():
    made = tempfile.mkdtemp(dir=WORK)
    yield made
    shutil.rmtree(made)


def run(commands, folder):
    """Runs commands, checks that they succeed, and returns their output."""
    printed = ""
    environment = {**os.environ, "PATH": f"{ROOT}:{os.environ['PATH']}"}
    for command in commands.splitlines():
        result = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert result.returncode == 0 or (result.returncode == 1 and command.startswith(COMPARE)), f"{command}\n{result.stdout}"
        printed += result.stdout
    return printed


@pytest.mark.parametrize("page", [
    pytest.param(page, id=name, marks=[pytest.mark.slow] * (name in SLOW)) for page in STORIES for name in [os.path.basename(page).removesuffix(".md")]])
def test_tutorials_work_as_written(page, folder) -> None:
    page_blocks, printed = blocks(page), ""
    assert any(block.language == "sh" for block in page_blocks)
    for block in page_blocks:
        if block.title:
            path = os.path.join(folder, block.title)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w") as file:
                file.write(block.text)
        elif block.language == "sh":
            printed = run(block.text, folder)
        elif block.language == "text":
            line = missing(block.text, printed)
            assert line is None, f"{page} shows a line that is not printed: {line}\n{printed}"
    if page.endswith("tutorial-first-swarm.md"):
        count_neighbours(os.path.join(folder, "out", "replay.html"))


def count_neighbours(page) -> None:
    """Checks that the value of each node on the page is its number of neighbours, which colours nodes whose answers contain no numbers."""
    _, frames, links = replay.read(page)
    _, nodes = frames[-1]
    for node, (*_, value) in nodes.items():
        assert value == pytest.approx(len({frozenset(link) for link in links if node in link}), abs=0.01)


def test_a_documented_line_that_is_not_printed_is_detected() -> None:
    assert missing("one\n...\nthr... 3", "one\ntwo\nthree is 3\n") is None
    assert missing("two\none", "one\ntwo\n") == "one"
