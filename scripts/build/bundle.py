"""Copies the inputs of a sweep's runs to a folder: `bundle.py SCENARIO FOLDER [--only-inputs] [--trust-jvm] [--runtime=NAME]...`. Sweeps call it.

FOLDER/programs.jar contains the programs for the scenario's runtime. If runtimes are given, each has its own file programs-NAME.jar instead.
FOLDER/inputs contains the files of the scenario's project. FOLDER/inputs.json lists their paths below FOLDER/inputs, and their hashes, by key of the
scenario.
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
from collektive import run_command

COMPILED = ("Newtonsoft.Json.dll", "Collektive.FlatBuffers.dll", "Collektive.Bridge.dll", "UnityEngine.dll", "Collektive.Player.exe")
ASSEMBLIES = (*COMPILED, *(f"{name}.so" for name in COMPILED), "Collektive.Bridge.pdb", "Collektive.Unity.dll", "Collektive.Unity.pdb", "UnityEngine.pdb",
              "Collektive.Player.pdb", "libcollektive_physics.so", "libcollektive_sqlite.so")


def run(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.folder
    graph.build("runtime")
    trust = ["--trust-jvm"] if arguments.trust_jvm else []
    plans = {f"programs-{runtime}.jar": player.plan(arguments.scenario, ["--set", f"runtime={runtime}", *trust]) for runtime in arguments.runtime}
    plans = plans or {"programs.jar": player.plan(arguments.scenario, trust)}
    parts = {key: part for plan in plans.values() for key, part in plan.parts.items()}
    _require_within(Path(os.path.abspath(arguments.scenario)).parent, parts["schema"])
    inputs = folder / "inputs"
    paths = {key: str(part.copy(inputs / key).relative_to(inputs)) for key, part in parts.items()}
    for part in parts.values():
        part.require_unchanged()
    (folder / "inputs.json").write_text(json.dumps({"paths": paths, "hashes": {key: part.digest for key, part in parts.items()}}))
    if arguments.only_inputs:
        return 0
    jars = {name: plan.programs_jar() for name, plan in plans.items()}
    dll = next(iter(plans.values())).scripts_dll()
    for target, files in {"csharp": [*(CSHARP / name for name in ASSEMBLIES), SHIM / "libcollektive_shim.so"],
                          "jars": [HOST_JAR, LIBRARY_JAR, ADAPTER_JAR], "": [dll, dll.with_suffix(".pdb")]}.items():
        (folder / target).mkdir(exist_ok=True)
        for file in files:
            shutil.copy(file, folder / target)
    for name, jar in jars.items():
        shutil.copy(jar, folder / name)
    # The sweep reads the scenario again.
    next(iter(plans.values())).require_unchanged()
    return 0


def _require_within(project: Path, schema: Part) -> None:
    """Raises `Failure` if a schema includes a file that is outside the project's folder, or outside its own folder if the schema is not in the project."""
    folder = project if project in schema.path.parents else schema.folder
    for name in schema.files:
        if folder not in Path(os.path.normpath(schema.folder / name)).parents:
            raise Failure(f"{schema.path}: the included file '{name}' is not in the folder '{folder}', which a sweep copies: move it there")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenario")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only-inputs", action="store_true")
    parser.add_argument("--trust-jvm", action="store_true")
    parser.add_argument("--runtime", action="append", default=[])
    parser.set_defaults(run=run)
    sys.exit(run_command(parser.parse_args()))
