"""Prints the product's version, or sets it: `version.py [X.Y.Z]`.

The version is defined in package.json. `version.py X.Y.Z` writes it to all files that contain it, and the tests compare these files with package.json.
"""
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build.places import ROOT

NUMBER = r"(\d+\.\d+\.\d+)"
# The files that contain the version, and the pattern of its context in each.
NAMED = {
    "package.json": rf'"version": "{NUMBER}"',
    "unity/package.json": rf'"version": "{NUMBER}"',
    "jvm-host/pom.xml": rf"<artifactId>collektive-parent</artifactId>\s*<version>{NUMBER}<",
    "jvm-host/*/pom.xml": rf"<artifactId>collektive-parent</artifactId>\s*<version>{NUMBER}<",
    "jvm-host/compiler-plugin/README.md": rf"compiler-plugin-{NUMBER}\.jar",
    "jvm-host/generator/src/main/kotlin/org/collektive/generator/Version.kt": rf'VERSION: String = "{NUMBER}"',
    "unity/Runtime/*/AssemblyInfo.cs": rf'AssemblyVersion\("{NUMBER}\.0"\)',
    "unity/Editor/AssemblyInfo.cs": rf'AssemblyVersion\("{NUMBER}\.0"\)',
    "unity/Headless~/Tests/Editor/ProjectFixture.cs": rf"compiler-plugin-{NUMBER}\.jar",
    "README.md": rf"org\.collektive\.unity-{NUMBER}\.tgz",
    "Documentation~/getting-started.md": rf"org\.collektive\.unity-{NUMBER}\.tgz",
    "experiments/pyproject.toml": rf'(?m)^version = "{NUMBER}"$',
    "CITATION.cff": rf"(?m)^version: {NUMBER}$",
}
SHIM = "native-shim/include/collektive_shim.h"


def product() -> str:
    """Returns the version of this checkout."""
    version: str = json.loads((ROOT / "package.json").read_text())["version"]
    return version


def files() -> Iterator[tuple[str, str]]:
    """Yields the path of each file that contains the version, with its pattern."""
    for pattern, named in NAMED.items():
        for path in sorted(ROOT.glob(pattern)):
            yield str(path.relative_to(ROOT)), named


def packed(version: str) -> str:
    """Returns the version as the C header writes it."""
    major, minor, patch = map(int, version.split("."))
    return f"0x{major << 16 | minor << 8 | patch:06x}"


def write(version: str) -> None:
    """Writes a version to all files that contain it."""
    for path, named in [*files(), (SHIM, "")]:
        text = (ROOT / path).read_text()
        if named:
            text = re.sub(named, lambda match: match[0].replace(match[1], version), text)
        else:
            text = re.sub(r"(#define CLK_VERSION) 0x\w+", rf"\1 {packed(version)}", text)
        (ROOT / path).write_text(text)


if __name__ == "__main__":
    if len(sys.argv) == 1:
        print(product())
    elif re.fullmatch(NUMBER, sys.argv[1]):
        write(sys.argv[1])
    else:
        sys.exit(f"version.py: '{sys.argv[1]}' is not a version: use three numbers, such as 1.2.3")
