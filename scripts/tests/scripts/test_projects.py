"""Tests that the build and the IDE projects contain every C# source, with the same references as in Unity."""
import json
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from build.csharp import SYMBOLS
from build.places import BUILD, GRAPH, ROOT

PROJECTS = {path.stem: ElementTree.parse(path) for path in (BUILD / "ide").glob("*.csproj")}
DEFINITIONS = [path for path in ROOT.glob("unity/**/*.asmdef") if "Samples~" not in path.parts]

pytestmark = pytest.mark.skipif("Collektive.Headless.Tests" not in PROJECTS, reason="the build has no NUnit")


def items(name: str, kind: str) -> list[Path]:
    return [Path(item.attrib["Include"]) for item in PROJECTS[name].iter(kind)]


def test_each_source_belongs_to_a_project() -> None:
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "unity/*.cs"],
                            capture_output=True, text=True, check=True).stdout.split("\0")
    places = [place for name in PROJECTS for place in items(name, "Compile")]
    compiled = {file for place in places for file in (place.parents[1].rglob("*.cs") if place.name == "*.cs" else [place])}
    assert [path for path in listed if path and (ROOT / path).exists() and ROOT / path not in compiled] == []


def test_an_assembly_is_compiled_again_if_the_options_of_the_bridge_change() -> None:
    inputs = subprocess.run(["ninja", "-t", "inputs", "Collektive.FlatBuffers.dll"], cwd=GRAPH, capture_output=True, text=True, check=True).stdout
    assert str(SYMBOLS) in inputs.splitlines()


@pytest.mark.parametrize("definition", DEFINITIONS, ids=lambda path: path.stem)
def test_an_assembly_refers_to_the_same_ones_as_in_unity(definition: Path) -> None:
    unity = json.loads(definition.read_text())
    declared = {*unity["references"], *(plugin.removesuffix(".dll") for plugin in unity["precompiledReferences"])} - {"UnityEditor.TestRunner"}
    built = {path.stem if path.suffix == ".csproj" else str(path) for kind in ("ProjectReference", "Reference") for path in items(definition.stem, kind)}
    assert built - {"UnityEngine", "UnityEditor"} == declared
