"""Tests that all files contain the same version."""
import fnmatch
import json
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest

from build import fetch, version
from build.places import BUILD, ROOT

POM = "{http://maven.apache.org/POM/4.0.0}"


def text(path: str) -> str:
    with open(os.path.join(ROOT, path)) as file:
        return file.read()


def pom(path: str) -> ElementTree.Element:
    return ElementTree.fromstring(text(path))


@pytest.mark.parametrize("pattern", version.NAMED)
def test_each_file_that_names_the_products_version_has_it(pattern: str) -> None:
    files = [path for path, named in version.files() if named == version.NAMED[pattern] and fnmatch.fnmatch(path, pattern)]
    assert files
    for path in files:
        assert set(re.findall(version.NAMED[pattern], text(path))) == {version.product()}, f"{path}: run scripts/build/version.py {version.product()}"


def test_the_shim_has_the_products_version() -> None:
    assert f"#define CLK_VERSION {version.packed(version.product())}\n" in text(version.SHIM)


def test_no_other_file_contains_the_version() -> None:
    listed = subprocess.run(["git", "-C", ROOT, "grep", "-lF", version.product()], capture_output=True, text=True).stdout.split("\n")
    known = {path for path, _ in version.files()}
    # These files are not searched, because the changelog names all versions, and other software may have the same version.
    others = re.compile(r"CHANGELOG\.md|THIRD-PARTY\.md|.*package-lock\.json|.*Cargo\.lock|.*requirements\.txt|")
    assert [path for path in listed if path not in known and not others.fullmatch(path)] == []


def test_the_players_manifest_names_the_flatbuffers_that_it_is_built_with() -> None:
    with open(os.path.join(BUILD, "flatbuffers/package.json")) as file:
        assert f'"flatbuffers", "{json.load(file)["version"]}"' in text("unity/Headless~/Player/Manifest.cs")


def found(pattern: str, text: str) -> str:
    """Returns the first group of a pattern in a text. The pattern must match."""
    match = re.search(pattern, text)
    assert match, pattern
    return match[1]


def third_party(name: str) -> str:
    """Returns the version in the row of THIRD-PARTY.md for a name."""
    return found(rf"(?m)^\|[^|]*(?<![\w@/-]){re.escape(name)}(?![\w-])[^|]*\| ([^|]*[^| ]) *\|", text("THIRD-PARTY.md"))


def test_the_list_of_third_parties_names_the_versions_that_are_fetched() -> None:
    with open(os.path.join(BUILD, "flatbuffers/package.json")) as file:
        flatbuffers = json.load(file)["version"]
    crate = found(r'flatc-fork = "=([^"]+)"', text("tools/flatbuffers/Cargo.toml"))
    physx = found(r'physx-sys = "=([^"]+)"', text("tools/physx/Cargo.toml"))
    with open(os.path.join(BUILD, "physx/physx/physx/include/foundation/PxPhysicsVersion.h")) as file:
        physx_version = ".".join(re.findall(r"define PX_PHYSICS_VERSION_(?:MAJOR|MINOR|BUGFIX) (\d+)", file.read()))
    assert third_party("PhysX") == f"{physx_version} ({physx})"
    with open(os.path.join(BUILD, "sqlite/sqlite3.h")) as file:
        sqlite_version = found(r'define SQLITE_VERSION +"([^"]+)"', file.read())
    sqlite = found(r'libsqlite3-sys = \{ version = "=([^"]+)"', text("tools/sqlite/Cargo.toml"))
    assert third_party("SQLite") == f"{sqlite_version} ({sqlite})"
    assert third_party("FlatBuffers C#") == f"{flatbuffers} ({crate})"
    for tools in ["npm", "prose", "site"]:
        for name, expected in json.loads(text(f"tools/{tools}/package.json"))["dependencies"].items():
            assert third_party(name) == expected, name
    experiments = [f"experiments/requirements{part}.txt" for part in ("", "-ray", "-test")]
    for path in ["tools/python/requirements.txt", "tools/flatc/requirements.txt", "tools/site/requirements.txt", "tools/live/requirements.txt", *experiments]:
        for name, expected in re.findall(r"(?m)^(\S+)==(\S+) --hash=sha256:", text(path)):
            assert third_party(name) == expected, name
    assert third_party("actionlint") == fetch.ACTIONLINT
    assert third_party("ktlint") == pom("tools/ktlint/pom.xml").findtext(f".//{POM}dependency/{POM}version")
