"""Tests that a test covers each code block of the pages, in this file or in the file that blocks.py names."""
import os
import re
import shlex

import pytest
from blocks import PAGES, blocks, of_kind
from command import collektive

from build.places import ROOT

# Blocks that no test covers, and the reason for each.
EXEMPT = {
    ("Documentation~/from-collektive.md", "kts"): "needs Collektive's artefacts, which the tests do not fetch",
    ("Documentation~/experiments.md", "bash"): "needs Slurm",
    ("Documentation~/experiments.md", "yaml"): "needs Kubernetes",
    ("docs/boundary.md", "text"): "a command line with placeholders; test_own.c runs it",
}
# Options in pages that belong to Unity's players.
UNITY = {"-batchmode", "-nographics"}
DESCRIPTORS = {"void": "V", "boolean": "Z", "int": "I", "long": "J", "byte[]": "[B", "String": "Ljava/lang/String;", "ByteBuffer": "Ljava/nio/ByteBuffer;"}


def text(path):
    with open(os.path.join(ROOT, path)) as file:
        return file.read()


def test_each_block_has_a_test() -> None:
    untested = [block for page in PAGES for block in blocks(page) if not block.kind]
    assert {(block.page, block.language) for block in untested} == EXEMPT.keys(), [block.place for block in untested]
    assert len(untested) == len(EXEMPT)


@pytest.mark.parametrize("page", PAGES)
def test_all_code_blocks_are_found(page) -> None:
    assert len(re.findall(r"(?m)^ *(?:```|~~~)", text(page))) == 2 * len(blocks(page))


def commands():
    """Returns the place and the words of each command line in the pages."""
    found = []
    for block in of_kind("command"):
        lines = block.text.replace("\\\n", " ").splitlines()
        for line in lines:
            # In a block without prompts, all lines are commands.
            if line.startswith("$ ") or not any(other.startswith("$ ") for other in lines):
                found.append((block.place, shlex.split(line.removeprefix("$ "), comments=True)))
    return found


@pytest.mark.parametrize("place, words", commands())
def test_commands_that_are_not_run_have_valid_options(place, words) -> None:
    command = os.path.basename(words[0])
    if command == "collektive":
        output = collektive(words[1], "--help")
        assert output.stdout.startswith("usage:"), words[1]
        unknown = [word for word in words[2:] if word.startswith("--") and not re.search(rf"{word}\b", output.stdout)]
    elif words[0].startswith("./Swarm"):
        unknown = [word for word in words[1:] if word.startswith("-") and word not in UNITY and word not in player_options()]
    else:
        unknown = [] if words == ["export", "PATH=$PWD:$PATH"] else [words[0]]
    assert unknown == []
    # Paths of files in this repository must exist.
    assert [word for word in words if re.match(r"(experiments|unity|docs)/", word) and not os.path.exists(os.path.join(ROOT, word))] == []


def player_options():
    """Returns the command-line options of players, which PlayerArguments derives from the settings."""
    fields = re.findall(r"(?m)^ +public (?!.*\()([\w<>]+) (\w+)(?: =|;)", text("unity/Runtime/Unity/Manager/SimulationSettings.cs"))
    prefix = re.search(r'Prefix = "([^"]+)"', text("unity/Runtime/Unity/Manager/PlayerArguments.cs"))[1]
    return {prefix + name for kind, name in fields if not kind.startswith("List")}


def test_options_of_players_are_known() -> None:
    assert {"-collektive-seed", "-collektive-schedule"} <= player_options()
    assert "-collektive-jars" not in player_options()


def test_java_of_the_boundary_page_matches_the_native_library() -> None:
    shim = text("native-shim/src/host.c")
    shim = shim.replace("CALL_TYPE", re.search(r'#define CALL_TYPE (".*")', shim)[1])
    # This part of the source lists the native methods of the class Shim and the entry points of Host.
    bound = re.findall(r'"(\w+)",\s*"(\(\S*\)\S+)"', shim[shim.index('NATIVE("grow"'):shim.index("entries[i].name")])
    documented = set()
    for block in of_kind("contract"):
        for kind, name, parameters in re.findall(r"static (?:native )?([\w\[\]]+) (\w+) ?\(([^)]*)\)", block.text):
            types = [parameter.split()[0] for parameter in parameters.split(",") if parameter.strip()]
            documented.add((name, f"({''.join(map(DESCRIPTORS.get, types))}){DESCRIPTORS[kind]}"))
    assert documented == set(bound)
