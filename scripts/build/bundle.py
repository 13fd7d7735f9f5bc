"""bundle.py SCENARIO FOLDER [--trust-jvm]: builds what the runs of a sweep need, and copies it to a folder. Sweeps call it."""
import argparse
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import graph, player
from build.places import ADAPTER_JAR, CSHARP, HOST_JAR, LIBRARY_JAR, SHIM
from collektive import guarded

ASSEMBLIES = ("Collektive.FlatBuffers.dll", "Collektive.Bridge.dll", "Collektive.Bridge.pdb", "Collektive.Unity.dll", "Collektive.Unity.pdb",
              "UnityEngine.dll", "UnityEngine.pdb", "Newtonsoft.Json.dll", "libcollektive_physics.so", "Collektive.Player.exe", "Collektive.Player.pdb")


def run(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.folder
    graph.build("runtime")
    plan = player.plan(arguments.scenario, ["--trust-jvm"] if arguments.trust_jvm else [])
    jar, dll = plan.programs_jar(), plan.scripts_dll()
    for target, files in {"csharp": [CSHARP / name for name in ASSEMBLIES], "native": [SHIM / "libcollektive_shim.so"],
                          "jars": [HOST_JAR, LIBRARY_JAR, ADAPTER_JAR], "": [dll, dll.with_suffix(".pdb")]}.items():
        (folder / target).mkdir(exist_ok=True)
        for file in files:
            shutil.copy(file, folder / target)
    shutil.copy(jar, folder / "programs.jar")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenario")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--trust-jvm", action="store_true")
    parser.set_defaults(run=run)
    sys.exit(guarded(parser.parse_args()))
