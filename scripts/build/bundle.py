"""bundle.py SCENARIO FOLDER [--only-inputs] [--trust-jvm]: copies what the runs of a sweep need to a folder. Sweeps call it.

FOLDER/inputs has the files of the scenario's project; FOLDER/inputs.json has their paths in it, and their hashes, by the scenario's keys.
"""
import argparse
import json
import os
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import graph, player
from build.console import Failure
from build.inputs import Part
from build.places import ADAPTER_JAR, CSHARP, HOST_JAR, LIBRARY_JAR, SHIM
from collektive import guarded

ASSEMBLIES = ("Collektive.FlatBuffers.dll", "Collektive.Bridge.dll", "Collektive.Bridge.pdb", "Collektive.Unity.dll", "Collektive.Unity.pdb",
              "UnityEngine.dll", "UnityEngine.pdb", "Newtonsoft.Json.dll", "libcollektive_physics.so", "Collektive.Player.exe", "Collektive.Player.pdb")


def run(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.folder
    graph.build("runtime")
    plan = player.plan(arguments.scenario, ["--trust-jvm"] if arguments.trust_jvm else [])
    project = Path(os.path.abspath(arguments.scenario)).parent
    paths = {key: copy(part, project, folder / "inputs", key) for key, part in plan.parts.items()}
    (folder / "inputs.json").write_text(json.dumps({"paths": paths, "hashes": plan.hashes()}))
    if arguments.only_inputs:
        return 0
    jar, dll = plan.programs_jar(), plan.scripts_dll()
    for target, files in {"csharp": [CSHARP / name for name in ASSEMBLIES], "native": [SHIM / "libcollektive_shim.so"],
                          "jars": [HOST_JAR, LIBRARY_JAR, ADAPTER_JAR], "": [dll, dll.with_suffix(".pdb")]}.items():
        (folder / target).mkdir(exist_ok=True)
        for file in files:
            shutil.copy(file, folder / target)
    shutil.copy(jar, folder / "programs.jar")
    return 0


def copy(part: Part, project: Path, inputs: Path, key: str) -> str:
    """Copies the files of a part of a project to a folder of that name in `inputs`, and returns the part's path in `inputs`.

    The schema and its includes stay as they lie to each other. Raises `Failure` if one of these lies outside the project.
    """
    # Of a schema that lies elsewhere, its folder takes the project's place.
    base = part.path if part.path.is_dir() else project if project in part.path.parents and key == "schema" else part.path.parent
    (inputs / key).mkdir(parents=True)
    for name, file in part.files.items():
        relative = os.path.relpath(os.path.join(part.path.parent if part.path.is_file() else part.path, name), base)
        if Path(relative).parts[0] == "..":
            raise Failure(f"{part.path}: the included file '{name}' lies outside the project's folder, '{base}': move it there; a sweep runs a copy of it")
        target = inputs / key / relative
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, target)
    part.require_unchanged()
    return os.path.normpath(os.path.join(key, os.path.relpath(part.path, base)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenario")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only-inputs", action="store_true")
    parser.add_argument("--trust-jvm", action="store_true")
    parser.set_defaults(run=run)
    sys.exit(guarded(parser.parse_args()))
