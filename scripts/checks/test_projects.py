"""The C# projects for IDEs contain every source, and agree with the assembly definitions of the package."""
import glob
import json
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from collections import Counter

from build.places import BUILD, ROOT

HEADLESS = os.path.join(ROOT, "unity/Headless~")
FOLDER = os.path.join(HEADLESS, "Projects")
FOLDERS = {"$(Headless)": HEADLESS + "/", "$(Unity)": os.path.join(ROOT, "unity/"), "$(Build)": f"{BUILD}/"}
PROJECTS = {os.path.basename(path).removesuffix(".csproj"): ElementTree.parse(path) for path in glob.glob(os.path.join(glob.escape(FOLDER), "*.csproj"))}


def items(name: str, kind: str) -> list[ElementTree.Element]:
    return list(PROJECTS[name].iter(kind))


def sources(item: ElementTree.Element) -> list[str]:
    pattern = item.attrib["Include"]
    for variable, folder in FOLDERS.items():
        pattern = pattern.replace(variable, glob.escape(folder))
    return [os.path.normpath(path) for path in glob.glob(pattern, recursive=True)]


def references(name: str) -> set[str]:
    """The projects that a project refers to, directly or through others."""
    direct = {item.attrib["Include"].removesuffix(".csproj") for item in items(name, "ProjectReference")}
    return direct.union(*map(references, direct))


def test_each_source_belongs_to_one_project() -> None:
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "unity/*.cs"],
                            capture_output=True, text=True, check=True).stdout.split("\0")
    expected = {os.path.join(ROOT, path) for path in listed if path and os.path.exists(os.path.join(ROOT, path))}
    # Items with a LinkBase belong to another project too.
    found = Counter(path for name in PROJECTS for item in items(name, "Compile") if "LinkBase" not in item.attrib for path in sources(item))
    assert expected - set(found) == set()
    assert [path for path, count in found.items() if count > 1] == []


def test_each_reference_of_a_project_exists() -> None:
    solution = ElementTree.parse(os.path.join(FOLDER, "Collektive.slnx"))
    assert sorted(project.attrib["Path"] for project in solution.iter("Project")) == sorted(name + ".csproj" for name in PROJECTS)
    for name in PROJECTS:
        assert references(name) <= set(PROJECTS)


def test_projects_of_the_package_refer_to_the_same_assemblies_as_in_unity() -> None:
    for path in glob.glob(os.path.join(ROOT, "unity/[!S]*/**/*.asmdef"), recursive=True):
        with open(path) as file:
            definition = json.load(file)
        plugins = [plugin.removesuffix(".dll") for plugin in definition["precompiledReferences"]]
        known = references(definition["name"]) | {item.attrib["Include"] for item in items(definition["name"], "Reference")}
        assert {*definition["references"], *plugins} - {"UnityEditor.TestRunner"} <= known, definition["name"]


def test_projects_have_the_symbols_of_the_bridge() -> None:
    with open(os.path.join(ROOT, "unity/Runtime/Bridge/csc.rsp")) as file, open(os.path.join(FOLDER, "Directory.Build.props")) as properties:
        assert re.findall(r"<DefineConstants>(.*)</DefineConstants>", properties.read()) == [file.read().strip().removeprefix("-define:")]
