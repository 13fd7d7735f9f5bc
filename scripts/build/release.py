#!/usr/bin/env python3
"""`bill_of_materials.py MAVEN.json JDK` prints the package's bill of materials (CycloneDX): Maven's of the JVM side, with what Maven does not know."""
import json
import os
import re
import sys

import package_json
from places import BUILD, ROOT

APACHE = [{"license": {"id": "Apache-2.0"}}]


def fetched(flatbuffers: str, crate: str, jdk: str) -> list[dict]:
    """Components of the package that are no dependencies of the JVM side's modules."""
    return [
        {"type": "library", "name": "flatbuffers", "version": flatbuffers, "licenses": APACHE, "purl": f"pkg:cargo/flatc-fork@{crate}",
         "description": "Runtimes for C# and Java, and the compiler flatc"},
        {"type": "platform", "name": "openjdk", "version": jdk, "licenses": [{"expression": "GPL-2.0-only WITH Classpath-exception-2.0"}],
         "description": "The bundled JVM, in packages whose names end with -jre only"},
    ]


def complete(bill: dict, package: dict, more: list[dict]) -> dict:
    """The bill of the package: our own modules are parts of it, not components of others."""
    bill["metadata"]["component"] = {"type": "library", "bom-ref": package["name"], "name": package["name"], "version": package["version"],
                                     "licenses": APACHE, "description": package["description"]}
    bill["components"] = [component for component in bill["components"] if component.get("group") != "org.collektive"] + more
    known = {component.get("bom-ref") for component in bill["components"]}
    bill["dependencies"] = [{"ref": package["name"], "dependsOn": sorted(known - {None})}]
    return bill


def read(path: str) -> str:
    with open(path) as file:
        return file.read()


def main() -> None:
    maven, jdk = sys.argv[1:]
    crate = re.search(r'flatc-fork = "=([^"]+)"', read(os.path.join(ROOT, "tools/flatbuffers/Cargo.toml")))[1]
    flatbuffers = json.loads(read(os.path.join(BUILD, "flatbuffers/package.json")))["version"]
    version = re.search(r'(?m)^JAVA_VERSION="([^"]+)"', read(os.path.join(jdk, "release")))[1]
    bill = complete(json.loads(read(maven)), package_json.read(ROOT), fetched(flatbuffers, crate, version))
    print(json.dumps(bill, indent=2))


if __name__ == "__main__":
    main()
