"""The manifests of the packages.

`python3 scripts/build/manifest.py` writes unity/package.json, for installations by git URL with `?path=/unity`, from package.json.
"""
import json
import os
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import metas
from build.places import ROOT

SYSTEMS = {"win-x64": "Windows (x64)", "linux-x64": "Linux (x64)", "linux-arm64": "Linux (ARM64)", "mac-x64": "macOS (Intel)",
           "mac-arm64": "macOS (Apple silicon)"}
JVM_PACKAGE = "org.collektive.unity.jvm."
# JVM packages that also contain the native library, and the first version of Unity that supports them. Older versions copy the Linux libraries for all
# processors to the same path in the player, so a build with two of them fails.
WITH_LIBRARY = {"linux-arm64": "6000.5"}


def read(root: str | Path) -> dict[str, Any]:
    """Returns the manifest of the package."""
    manifest: dict[str, Any] = json.loads(Path(root, "package.json").read_text())
    return manifest


def sources(root: Path) -> list[str]:
    """Returns the entries of the allow-list `files` that exist in the clone, and the manifest, which npm packs even if it is not listed."""
    return ["package.json"] + [path for path in read(root)["files"] if (root / path).exists()]


def links(repository: str, version: str) -> dict[str, str]:
    """Returns the addresses for the manifest of a release, which are pages of its tag. An example of a repository is https://github.com/OWNER/NAME."""
    pages = f"{repository.rstrip('/')}/blob/v{version}"
    return {"documentationUrl": f"{pages}/Documentation~/index.md", "changelogUrl": f"{pages}/CHANGELOG.md", "licensesUrl": f"{pages}/LICENSE"}


def write_links(folder: Path, repository: str) -> None:
    """Adds the addresses of a release to the manifests of a staged package."""
    for path in (folder / "package.json", folder / "unity/package.json"):
        if path.exists():
            manifest = json.loads(path.read_text())
            path.write_text(json.dumps({**manifest, **links(repository, manifest["version"])}, indent=2) + "\n")


def for_git(root: str | Path) -> str:
    """Returns the manifest of a package that consists of the folder unity."""
    manifest = read(root)
    del manifest["files"]
    for sample in manifest["samples"]:
        sample["path"] = os.path.relpath(sample["path"], "unity")
    return json.dumps(manifest, indent=2) + "\n"


def for_jvm(root: str | Path, platform: str) -> dict[str, Any]:
    """Returns the manifest of the package that contains a platform's JVM."""
    core = read(root)
    return {
        "name": JVM_PACKAGE + platform,
        "displayName": "Collektive for Unity: JVM for " + SYSTEMS[platform],
        "version": core["version"],
        "unity": WITH_LIBRARY.get(platform, core["unity"]),
        "description": "The Java runtime (Eclipse Temurin) that Collektive for Unity runs its programs on. Licences: Jvm~/" + platform + "/legal.",
        "license": "GPL-2.0-only WITH Classpath-exception-2.0",
        "author": core["author"],
        "files": ["Jvm~", *(["Plugins", "Plugins.meta"] if platform in WITH_LIBRARY else []), "package.json.meta"],
    }


def write_jvm(root: str | Path, platform: str, folder: Path) -> None:
    """Writes the manifest of a platform's JVM package, and its meta, to a folder."""
    (folder / "package.json").write_text(json.dumps(for_jvm(root, platform), indent=2) + "\n")
    (folder / "package.json.meta").write_text(metas.meta_of(folder, "package.json", JVM_PACKAGE + platform))


if __name__ == "__main__":
    (ROOT / "unity/package.json").write_text(for_git(ROOT))
