#!/usr/bin/env python3
"""The package's manifests.

`package_json.py ROOT --sources` lists what of the clone goes into the package: the allow-list `files` of package.json, without what
the build makes. `package_json.py ROOT --git` writes unity/package.json, for installations by git URL with `?path=/unity`.
`package_json.py ROOT --jvm PLATFORM FOLDER` writes the manifest of a platform's JVM package into a folder, with its meta.
"""
import json
import os
import sys

import metas

SYSTEMS = {"win-x64": "Windows (x64)", "linux-x64": "Linux (x64)", "linux-arm64": "Linux (ARM64)", "mac-x64": "macOS (Intel)",
           "mac-arm64": "macOS (Apple silicon)"}


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


def for_jvm(root, platform):
    """The manifest of the package that holds a platform's JVM."""
    core = read(root)
    return {
        "name": "org.collektive.unity.jvm." + platform,
        "displayName": "Collektive for Unity: JVM for " + SYSTEMS[platform],
        "version": core["version"],
        "unity": core["unity"],
        "description": "The Java runtime (Eclipse Temurin) that Collektive for Unity runs its programs on. Licences: Jvm~/" + platform + "/legal.",
        "license": "GPL-2.0-only WITH Classpath-exception-2.0",
        "author": core["author"],
        "files": ["Jvm~", "package.json.meta"],
    }


def write_jvm(root, platform, folder):
    with open(os.path.join(folder, "package.json"), "w") as file:
        json.dump(for_jvm(root, platform), file, indent=2)
        file.write("\n")
    with open(os.path.join(folder, "package.json.meta"), "w") as file:
        file.write(metas.meta_of(folder, "package.json", "org.collektive.unity.jvm." + platform))


def main():
    root, command, *rest = sys.argv[1:]
    if command == "--sources":
        print("\n".join(sources(root)))
    elif command == "--git":
        with open(os.path.join(root, "unity/package.json"), "w") as file:
            file.write(for_git(root))
    elif command == "--jvm":
        write_jvm(root, *rest)
    else:
        sys.exit(f"package_json.py: unknown command {command}")


if __name__ == "__main__":
    main()
