"""Checks the manifest: its names and samples, and that its allow-list contains exactly the assets."""
import fnmatch
import os
import re
from collections.abc import Iterator

from build import manifest as manifests
from validator.assets import Assets


def problems(assets: Assets) -> Iterator[str]:
    root = assets.root
    manifest = manifests.read(root)
    if not re.fullmatch(r"[a-z0-9._-]+", manifest["name"]):
        yield f"package.json: '{manifest['name']}' is not a package name"
    if not re.fullmatch(r"\d+\.\d+\.\d+(-[0-9A-Za-z.]+)?", manifest["version"]):
        yield f"package.json: '{manifest['version']}' is not a version"
    for sample in manifest["samples"]:
        if not os.path.isdir(os.path.join(root, sample["path"])):
            yield f"package.json: the sample '{sample['displayName']}' is missing: {sample['path']} does not exist"
    listed = {sample["path"] for sample in manifest["samples"]}
    for folder in sorted(os.listdir(os.path.join(root, "unity/Samples~"))):
        path = "unity/Samples~/" + folder
        if os.path.isdir(os.path.join(root, path)) and path not in listed:
            yield f"{path}: the sample is not in package.json"
    allowed = [entry for entry in manifest["files"] if not entry.startswith("!")]
    refused = [entry[1:] for entry in manifest["files"] if entry.startswith("!")]
    for asset in assets.paths:
        # Manifests are not listed. npm always packs package.json, and the manifest in unity/ is only for git URLs.
        for path in [asset, asset + ".meta"]:
            if os.path.isdir(os.path.join(root, path)) or path in ("package.json", "unity/package.json", "unity/package.json.meta"):
                continue
            if not any(path == entry or path.startswith(entry + "/") for entry in allowed) and not any(fnmatch.fnmatch(path, entry) for entry in refused):
                yield f"{path}: not in the allow-list 'files' of package.json"
    for_git = os.path.join(root, "unity/package.json")
    if os.path.exists(for_git):
        with open(for_git) as file:
            if file.read() != manifests.for_git(root):
                yield "unity/package.json: outdated; run scripts/build/manifest.py"
