"""Creates the bundle of a sweep, a folder with copies of the scenario's inputs, the compiled code and the player."""
import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

from . import files
from .files import PART
from .positions import ExperimentError, Located


def write_scenario(scenario: Located, folder: str) -> None:
    """Writes the scenario to the bundle, with the paths and hashes of the copied inputs from inputs.json."""
    root: dict[str, Any] = {**scenario.root}
    with open(os.path.join(folder, "inputs.json"), encoding="utf-8") as file:
        root.update(json.load(file)["paths"])
    # Runs of a sweep do not write replay pages.
    outputs = root.get("outputs", {})
    if isinstance(outputs, dict):
        root["outputs"] = {**outputs, "metrics": True, "replay": False, "pictures": False}
    with open(os.path.join(folder, "inputs/scenario.json"), "w", encoding="utf-8") as file:
        json.dump(root, file, indent=2)


FINGERPRINT = "fingerprint.txt"
"""The file of a bundle with the fingerprint of its other files."""


def fingerprint(folder: str) -> str:
    """Returns the SHA-256 of the names and contents of all files in a folder, except its fingerprint."""
    total = hashlib.sha256()
    for where, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(where, name)
            if path == os.path.join(folder, FINGERPRINT):
                continue
            with open(path, "rb") as file:
                total.update(f"{os.path.relpath(path, folder)}\0{hashlib.sha256(file.read()).hexdigest()}\n".encode())
    return total.hexdigest()


def programs_jar(bundle: str, runtime: str) -> str:
    """Returns the path of the programs for a runtime. An empty name stands for the runtime of the scenario."""
    return os.path.join(bundle, f"programs-{runtime.lower()}.jar" if runtime else "programs.jar")


def prepare(scenario: Located, bundle: str, trust: bool, runtimes: Sequence[str] = ()) -> None:
    """
    Creates the bundle, or checks that an existing bundle has the same inputs, so that all runs of a sweep use the same code.

    The programs are compiled for the given runtimes. Without runtimes, they are compiled for the runtime of the scenario. The environment variable
    `COLLEKTIVE` is the path of the command in the checkout that builds the bundle.
    """
    for runtime in runtimes if os.path.isdir(bundle) else ():
        if not os.path.exists(programs_jar(bundle, runtime)):
            raise ExperimentError(f"'{bundle}' contains no programs for the runtime '{runtime}': name another folder with --out")
    if os.path.isdir(bundle) and not is_unchanged(bundle):
        raise ExperimentError(f"'{bundle}' was changed after the earlier runs: restore it, or name another folder with --out")
    work = bundle + PART
    files.make_marked(work)
    try:
        script = os.path.join(os.path.dirname(os.environ["COLLEKTIVE"]), "scripts/build/bundle.py")
        options = [*(["--only-inputs"] if os.path.isdir(bundle) else []), *(["--trust-jvm"] if trust else []),
                   *(f"--runtime={runtime}" for runtime in runtimes)]
        if subprocess.run([sys.executable, "-I", script, os.path.abspath(scenario.path), os.path.abspath(work), *options]).returncode != 0:
            raise ExperimentError("the scenario could not be built; the messages are above")
        if Located(scenario.path).text != scenario.text:
            raise ExperimentError(f"'{scenario.path}' changed while it was read: run the command again")
        write_scenario(scenario, work)
        if os.path.isdir(bundle):
            if fingerprint(os.path.join(work, "inputs")) != fingerprint(os.path.join(bundle, "inputs")):
                raise ExperimentError(f"the scenario or its files differ from those of the runs in '{os.path.dirname(bundle)}': "
                                      "name another folder with --out, or undo the change")
            return
        files.write_part(os.path.join(work, FINGERPRINT), fingerprint(work))
        files.publish(bundle)
    finally:
        files.remove(work)


def require_unchanged(bundle: str) -> None:
    """Raises `ExperimentError` if the bundle was changed during a sweep or search, whose processes read its files at different times."""
    if not is_unchanged(bundle):
        raise ExperimentError(f"'{bundle}' was changed during the runs, which may have different inputs: name another folder with --out")


def is_unchanged(bundle: str) -> bool:
    """Returns whether the bundle has the files with which it was created."""
    path = os.path.join(bundle, FINGERPRINT)
    if not os.path.isfile(path):
        # Bundles of earlier versions have no fingerprint.
        return os.path.exists(os.path.join(bundle, "inputs.json"))
    with open(path, encoding="utf-8") as file:
        return file.read() == fingerprint(bundle)
