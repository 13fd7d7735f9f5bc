"""What the runs of a sweep need, in one folder: copies of the scenario's inputs, what is compiled of them, and the player."""
import hashlib
import json
import os
import re
import shutil
import subprocess
from typing import Any

from . import files
from .files import PART
from .positions import ExperimentError, Located

SOURCES = (".cs", ".kt", ".java", ".jar")
INCLUDE = re.compile(r'^\s*include\s+"([^"]+)"', re.M)


def copy_inputs(scenario: str, folder: str) -> None:
    """Copies a scenario and what it names; paths in the copy are relative to it."""
    root: dict[str, Any] = Located(scenario).root
    base = os.path.dirname(os.path.abspath(scenario))
    os.makedirs(folder)
    for key in ("scripts", "programs", "runtimeJars", "runtimePlugin"):
        if not isinstance(root.get(key), str) or not root[key]:
            continue
        source = os.path.join(base, root[key])
        if os.path.isdir(source):
            _copy_sources(source, os.path.join(folder, key))
            root[key] = key
        elif os.path.isfile(source):
            root[key] = os.path.basename(source)
            shutil.copyfile(source, os.path.join(folder, root[key]))
    if isinstance(root.get("schema"), str):
        _copy_schema(os.path.join(base, root["schema"]), os.path.join(folder, "schema"))
        root["schema"] = "schema/" + os.path.basename(root["schema"])
    # A sweep's runs make no pages.
    outputs = root.setdefault("outputs", {})
    if isinstance(outputs, dict):
        outputs.update(metrics=True, replay=False, pictures=False)
    with open(os.path.join(folder, "scenario.json"), "w", encoding="utf-8") as file:
        json.dump(root, file, indent=2)


def _copy_sources(source: str, target: str) -> None:
    for where, folders, names in os.walk(source):
        folders[:] = sorted(name for name in folders if name != "Generated")
        for name in names:
            if name.endswith(SOURCES):
                place = os.path.join(target, os.path.relpath(where, source))
                os.makedirs(place, exist_ok=True)
                shutil.copyfile(os.path.join(where, name), os.path.join(place, name))


def _copy_schema(schema: str, target: str) -> None:
    """The schema and what it includes from its folder; the package's own includes are found by themselves."""
    base, pending, done = os.path.dirname(schema), [os.path.basename(schema)], set()
    while pending:
        name = pending.pop()
        source = os.path.join(base, name)
        if name in done or not os.path.isfile(source):
            continue
        done.add(name)
        copy = os.path.join(target, name)
        os.makedirs(os.path.dirname(copy), exist_ok=True)
        shutil.copyfile(source, copy)
        with open(source, encoding="utf-8") as file:
            pending += INCLUDE.findall(file.read())


def fingerprint(folder: str) -> str:
    """SHA-256 of the names and contents of all files in a folder."""
    total = hashlib.sha256()
    for where, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(where, name)
            with open(path, "rb") as file:
                total.update(f"{os.path.relpath(path, folder)}\0{hashlib.sha256(file.read()).hexdigest()}\n".encode())
    return total.hexdigest()


def prepare(scenario: str, bundle: str, trust: bool) -> None:
    """
    Makes the bundle, or checks that the scenario's inputs are those of the bundle that is there: runs of one sweep have one program.
    `COLLEKTIVE` names the command of the checkout whose scripts/build/bundle.py builds.
    """
    work = bundle + PART
    files.make_marked(work)
    try:
        inputs = os.path.join(work, "inputs")
        copy_inputs(scenario, inputs)
        if os.path.isdir(bundle):
            if fingerprint(inputs) != fingerprint(os.path.join(bundle, "inputs")):
                raise ExperimentError(f"the scenario, its scripts, schema or programs are not those that the runs in '{os.path.dirname(bundle)}' were made of: "
                                      "name another folder with --out, or undo the change")
            return
        script = os.path.join(os.path.dirname(os.environ["COLLEKTIVE"]), "scripts/build/bundle.py")
        command = ["python3", "-I", script, os.path.abspath(scenario), os.path.abspath(work)]
        if subprocess.run(command + (["--trust-jvm"] if trust else [])).returncode != 0:
            raise ExperimentError("the scenario could not be built; see above")
        files.publish(bundle)
    finally:
        files.remove(work)
