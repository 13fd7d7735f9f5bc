#!/usr/bin/env python3
"""The package's manifests.

`package_json.py ROOT --sources` lists what of the clone goes into the package: the allow-list `files` of package.json, without what
the build makes. `package_json.py ROOT --git` writes unity/package.json, for installations by git URL with `?path=/unity`.
"""
import json
import os
import sys


def read(root):
    with open(os.path.join(root, "package.json")) as file:
        return json.load(file)


def sources(root):
    """Entries of the allow-list that lie in the clone, and the manifest itself, which npm packs unasked."""
    return ["package.json"] + [path for path in read(root)["files"] if os.path.exists(os.path.join(root, path))]


def for_git(root):
    """The root's manifest as it must be for a package whose root is the folder unity."""
    manifest = read(root)
    del manifest["files"]
    for sample in manifest["samples"]:
        sample["path"] = os.path.relpath(sample["path"], "unity")
    return json.dumps(manifest, indent=2) + "\n"


def main():
    root, command = sys.argv[1:]
    if command == "--sources":
        print("\n".join(sources(root)))
    elif command == "--git":
        with open(os.path.join(root, "unity/package.json"), "w") as file:
            file.write(for_git(root))
    else:
        sys.exit(f"package_json.py: unknown command {command}")


if __name__ == "__main__":
    main()
