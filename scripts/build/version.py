#!/usr/bin/env python3
"""The product's version: `version.py` prints it; `version.py X.Y.Z` writes it to all files that name it.

package.json is the source. The tests compare the other files with it.
"""
import glob
import json
import os
import re
import sys

from places import ROOT

NUMBER = r"(\d+\.\d+\.\d+)"
# Files, and what stands around the version in them.
NAMED = {
    "package.json": rf'"version": "{NUMBER}"',
    "unity/package.json": rf'"version": "{NUMBER}"',
    "jvm-host/pom.xml": rf"<artifactId>collektive-parent</artifactId>\s*<version>{NUMBER}<",
    "jvm-host/*/pom.xml": rf"<artifactId>collektive-parent</artifactId>\s*<version>{NUMBER}<",
    "gradle.properties": rf"(?m)^version={NUMBER}$",
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


def read(path):
    with open(os.path.join(ROOT, path)) as file:
        return file.read()


def product():
    return json.loads(read("package.json"))["version"]


def files():
    """Paths of all files that name the version, with the pattern of each."""
    for pattern, named in NAMED.items():
        for path in sorted(glob.glob(os.path.join(ROOT, pattern))):
            yield os.path.relpath(path, ROOT), named


def packed(version):
    """The version as the C header writes it."""
    major, minor, patch = map(int, version.split("."))
    return f"0x{major << 16 | minor << 8 | patch:06x}"


def write(path, text):
    with open(os.path.join(ROOT, path), "w") as file:
        file.write(text)


def main():
    if len(sys.argv) == 1:
        print(product())
        return
    version = sys.argv[1]
    if not re.fullmatch(NUMBER, version):
        sys.exit(f"version.py: '{version}' is no version: three numbers are needed, like 1.2.3")
    for path, named in files():
        write(path, re.sub(named, lambda match: match[0].replace(match[1], version), read(path)))
    write(SHIM, re.sub(r"(#define CLK_VERSION) 0x\w+", rf"\1 {packed(version)}", read(SHIM)))


if __name__ == "__main__":
    main()
