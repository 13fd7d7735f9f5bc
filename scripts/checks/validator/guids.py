"""Checks that GUIDs never change, because users' scenes refer to assets by GUID.

`scripts/checks/validator/guids.txt` contains the GUID of every asset to which a scene, a prefab or an assembly definition can refer.
"""
import os
from collections.abc import Iterable, Iterator

from validator.assets import Assets

GUIDS_FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "guids.txt")


def referable(assets: Assets, classes: Iterable[str]) -> dict[str, str]:
    """Returns the assets to which files outside the package can refer, by GUID."""
    names = {name.rsplit(".", 1)[-1] for name in classes}
    # Importers are included, because the metas of libraries refer to their importer.
    scripts = [path for path in assets.with_ending(".cs") if os.path.basename(path)[:-3] in names or path.endswith("Importer.cs")]
    paths = set(scripts + assets.with_ending(".asmdef", ".prefab", ".mat", ".shader", ".unity", ".asset")) | set(assets.libraries)
    return {guid: path for guid, path in assets.guids.items() if path in paths}


def read(guids_file: str) -> dict[str, str]:
    with open(guids_file) as file:
        entries = (line.partition(" ") for line in file.read().splitlines())
        return {guid: path for guid, _, path in entries}


def problems(assets: Assets, classes: Iterable[str], guids_file: str = GUIDS_FILE) -> Iterator[str]:
    """Yields a line for each missing, changed or unlisted GUID."""
    listed = read(guids_file)
    present = referable(assets, classes)
    for guid, path in sorted(listed.items(), key=lambda entry: entry[1]):
        if guid not in present:
            yield f"{path}: its GUID {guid} is missing, which breaks users' scenes; restore it in the asset's .meta file, even if the asset was renamed"
    for guid, path in sorted(present.items(), key=lambda entry: entry[1]):
        if listed.get(guid) != path:
            yield f"{path}: not in {os.path.basename(guids_file)} with GUID {guid}; run scripts/checks/validate.py --update"


def update(assets: Assets, classes: Iterable[str], guids_file: str = GUIDS_FILE) -> None:
    """Adds new and renamed assets to the file. Keeps the entries of missing assets, so these are still reported."""
    listed = {**read(guids_file), **referable(assets, classes)}
    with open(guids_file, "w") as file:
        for guid, path in sorted(listed.items(), key=lambda entry: entry[1]):
            file.write(f"{guid} {path}\n")
