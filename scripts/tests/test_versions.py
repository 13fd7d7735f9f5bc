"""A version that several files must name is the same in all of them."""
import glob
import json
import os
import re
import xml.etree.ElementTree as ElementTree

import pytest
from places import BUILD, ROOT

POM = "{http://maven.apache.org/POM/4.0.0}"


def text(path):
    with open(os.path.join(ROOT, path)) as file:
        return file.read()


def pom(path):
    return ElementTree.fromstring(text(path))


VERSION = json.loads(text("package.json"))["version"]
MODULES = sorted(os.path.relpath(path, ROOT) for path in glob.glob(os.path.join(ROOT, "jvm-host/*/pom.xml")))


@pytest.mark.parametrize("path", MODULES)
def test_each_module_of_the_jvm_side_has_the_products_version(path):
    assert pom("jvm-host/pom.xml").findtext(POM + "version") == VERSION
    assert pom(path).findtext(f"{POM}parent/{POM}version") == VERSION


@pytest.mark.parametrize("path", ["unity/Runtime/Bridge/AssemblyInfo.cs", "unity/Runtime/Unity/AssemblyInfo.cs", "unity/Editor/AssemblyInfo.cs"])
def test_each_assembly_has_the_products_version(path):
    assert f'AssemblyVersion("{VERSION}.0")' in text(path)


def test_generator():
    assert f'VERSION: String = "{VERSION}"' in text("jvm-host/generator/src/main/kotlin/org/collektive/generator/Version.kt")


def test_the_manifest_for_git_urls_has_the_products_version():
    assert json.loads(text("unity/package.json"))["version"] == VERSION


def test_the_shim_has_the_products_version():
    major, minor, patch = map(int, VERSION.split("."))
    assert f"#define CLK_VERSION 0x{major << 16 | minor << 8 | patch:06x}" in text("native-shim/include/collektive_shim.h")


@pytest.mark.parametrize("path", ["README.md", "Documentation~/getting-started.md"])
def test_pages_name_the_package_with_its_version(path):
    assert re.findall(r"org\.collektive\.unity-(\d[\d.]*\d)\.tgz", text(path)) == [VERSION]


def test_the_players_manifest_names_the_flatbuffers_that_it_is_built_with():
    with open(os.path.join(BUILD, "flatbuffers/package.json")) as file:
        assert f'"flatbuffers", "{json.load(file)["version"]}"' in text("unity/Headless~/Player/Manifest.cs")


def third_party(name):
    """The version in the row of THIRD-PARTY.md about a name."""
    row = re.search(rf"(?m)^\|[^|]*(?<![\w@/-]){re.escape(name)}(?![\w-])[^|]*\| ([^|]*[^| ]) *\|", text("THIRD-PARTY.md"))
    return row and row[1]


def test_the_list_of_third_parties_names_the_versions_that_are_fetched():
    with open(os.path.join(BUILD, "flatbuffers/package.json")) as file:
        flatbuffers = json.load(file)["version"]
    crate = re.search(r'flatc-fork = "=([^"]+)"', text("tools/flatbuffers/Cargo.toml"))[1]
    physx = re.search(r'physx-sys = "=([^"]+)"', text("tools/physx/Cargo.toml"))[1]
    with open(os.path.join(BUILD, "physx/physx/physx/include/foundation/PxPhysicsVersion.h")) as file:
        version = ".".join(re.findall(r"define PX_PHYSICS_VERSION_(?:MAJOR|MINOR|BUGFIX) (\d+)", file.read()))
    assert third_party("PhysX") == f"{version} ({physx})"
    assert third_party("FlatBuffers C#") == f"{flatbuffers} ({crate})"
    for name, version in json.loads(text("tools/npm/package.json"))["dependencies"].items():
        assert third_party(name) == version, name
    for path in ["tools/python/requirements.txt", *(f"experiments/requirements{part}.txt" for part in ("", "-ray", "-test"))]:
        for name, version in re.findall(r"(?m)^(\S+)==(\S+)$", text(path)):
            assert third_party(name) == version, name
    assert third_party("ktlint") == pom("tools/ktlint/pom.xml").findtext(f".//{POM}dependency/{POM}version")
