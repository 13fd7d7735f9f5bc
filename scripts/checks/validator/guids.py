"""Checks that GUIDs never change, because users' scenes refer to assets by their GUIDs.

`scripts/checks/validator/guids.txt` contains the GUID of every asset that a scene, a prefab or an assembly definition can refer to.
"""
import os

LEDGER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "guids.txt")


def referable(assets, classes):
    """Returns the assets that files outside the package can refer to, by GUID."""
    names = {name.rsplit(".", 1)[-1] for name in classes}
    scripts = [path for path in assets.with_ending(".cs") if os.path.basename(path)[:-3] in names]
    paths = set(scripts + assets.with_ending(".asmdef", ".prefab", ".mat", ".shader", ".unity", ".asset"))
    return {guid: path for guid, path in assets.guids.items() if path in paths}


def read(ledger):
    with open(ledger) as file:
        return dict(line.split(" ", 1) for line in file.read().splitlines())


def problems(assets, classes, ledger=LEDGER):
    """Yields a line for each missing, changed or unlisted GUID."""
    listed = read(ledger)
    present = referable(assets, classes)
    for guid, path in sorted(listed.items(), key=lambda entry: entry[1]):
        if guid not in present:
            yield f"{path}: its GUID {guid} is missing, which breaks users' scenes; restore the GUID in the meta of the asset, also if it was renamed"
    for guid, path in sorted(present.items(), key=lambda entry: entry[1]):
        if listed.get(guid) != path:
            yield f"{path}: not in {os.path.basename(ledger)} with GUID {guid}; run scripts/checks/validate.py --update"


def update(assets, classes, ledger=LEDGER) -> None:
    """Adds new and renamed assets. Keeps missing ones, which remain errors."""
    listed = {**read(ledger), **referable(assets, classes)}
    with open(ledger, "w") as file:
        for guid, path in sorted(listed.items(), key=lambda entry: entry[1]):
            file.write(f"{guid} {path}\n")
