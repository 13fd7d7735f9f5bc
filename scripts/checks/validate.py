#!/usr/bin/env python3
"""Checks the package's assets: `validate.py ROOT FIELDS` prints a line for each error, and exits with 1 if it finds any.

FIELDS is the output of Collektive.SerializedFields.exe for the package's assemblies. The option --update adds new GUIDs to
scripts/checks/validator/guids.txt.
"""
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), HERE]
from validator import asmdefs, guids, icons, packing, players, plugins, references, serialized_fields  # noqa: E402
from validator.assets import Assets  # noqa: E402
from validator.serialized_fields import ScriptClass  # noqa: E402

from build import metas  # noqa: E402


def problems(root: str | Path, classes: Mapping[str, ScriptClass], guids_file: str = guids.GUIDS_FILE) -> Iterator[str]:
    """Yields the errors in the package below `root`."""
    yield from metas.problems(root)
    assets = Assets(root)
    yield from guids.problems(assets, classes, guids_file)
    yield from asmdefs.problems(assets)
    yield from icons.problems(assets)
    yield from references.problems(assets, classes)
    yield from packing.problems(assets)
    yield from players.problems(assets)
    yield from plugins.problems(plugins.packaged())


def main() -> None:
    root, fields = sys.argv[1:3]
    with open(fields) as file:
        classes = serialized_fields.parse(file.read())
    if "--update" in sys.argv:
        guids.update(Assets(root), classes)
    found = list(problems(root, classes))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
