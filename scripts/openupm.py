#!/usr/bin/env python3
"""`openupm.py REPOSITORY_URL` prints the package's metadata for the registry OpenUPM, which builds packages from tags of a repository."""
import json
import sys

import package_json
from places import ROOT


def metadata(url: str) -> dict:
    manifest = package_json.read(ROOT)
    return {
        "name": manifest["name"],
        "displayName": manifest["displayName"],
        "description": manifest["description"],
        "repoUrl": url,
        "licenseSpdxId": manifest["license"],
        "topics": ["ai", "physics"],
        "hunter": url.rstrip("/").split("/")[-2],
        # Tags of commits with the package's content: the repository has no built parts.
        "gitTagPrefix": "upm/",
        "minVersion": manifest["version"],
        "readme": "upm:README.md",
    }


if __name__ == "__main__":
    # YAML contains JSON's scalars.
    print("\n".join(f"{key}: {json.dumps(value)}" for key, value in metadata(sys.argv[1]).items()))
