"""GUIDs never change: users' scenes refer to the package's assets by nothing else.

`scripts/checks/validator/guids.txt` holds the GUID of every asset that a scene, a prefab or an assembly definition can refer to.
"""
import os
from collections.abc import Iterable, Iterator

from validator.assets import Assets

LEDGER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "guids.txt")


def lasting(assets: Assets, classes: Iterable[str]) -> dict[str, str]:
    """Asset by GUID of all that can be referred to from outside of the package."""
    names = {name.rsplit(".", 1)[-1] for name in classes}
    scripts = [path for path in assets.with_ending(".cs") if os.path.basename(path)[:-3] in names]
    wanted = set(scripts + assets.with_ending(".asmdef", ".prefab", ".mat", ".shader", ".unity", ".asset"))
    return {guid: path for guid, path in assets.guids.items() if path in wanted}


def read(ledger: str) -> dict[str, str]:
    with open(ledger) as file:
        entries = (line.partition(" ") for line in file.read().splitlines())
        return {guid: path for guid, _, path in entries}


def problems(assets: Assets, classes: Iterable[str], ledger: str = LEDGER) -> Iterator[str]:
    """One line for each GUID that vanished or changed, and for each that is not listed yet."""
    listed = read(ledger)
    present = lasting(assets, classes)
    for guid, path in sorted(listed.items(), key=lambda entry: entry[1]):
        if guid not in present:
            yield f"{path}: its GUID {guid} is gone, which breaks users' scenes; give the asset (or what it was renamed to) this GUID again"
    for guid, path in sorted(present.items(), key=lambda entry: entry[1]):
        if listed.get(guid) != path:
            yield f"{path}: not in {os.path.basename(ledger)} with GUID {guid}; run scripts/checks/validate.py --update"


def update(assets: Assets, classes: Iterable[str], ledger: str = LEDGER) -> None:
    """Enters new and renamed assets. What vanished stays, and with it the problem."""
    listed = {**read(ledger), **lasting(assets, classes)}
    with open(ledger, "w") as file:
        for guid, path in sorted(listed.items(), key=lambda entry: entry[1]):
            file.write(f"{guid} {path}\n")
