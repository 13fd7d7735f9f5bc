"""Compiles an installed package in the same way as Unity."""
import shutil
from collections.abc import Sequence
from pathlib import Path

from build import csharp
from build.places import CSHARP, ROOT
from build.system import MONO_POSIX

HEADLESS = ROOT / "unity/Headless~"


def compile_project(project: Path) -> None:
    """Compiles the package in Packages/ of a project, its samples and a player to bin/.

    The player, and the stand-in for Unity with its physics, come from this checkout.
    """
    package, folder = project / "Packages/org.collektive.unity/unity", project / "bin"
    folder.mkdir()
    for file in (package / "Runtime/Plugins/Collektive.FlatBuffers.dll", CSHARP / "Newtonsoft.Json.dll", CSHARP / "libcollektive_physics.so"):
        shutil.copy(file, folder)

    def compile_one(name: str, sources: Sequence[Path], references: Sequence[str], *options: str) -> None:
        words = ["-debug-", *(f"-r:{folder / reference}" for reference in references), *options]
        csharp.compile_assembly(folder / name, csharp.sources(sources), words)
        (folder / f"{name}.rsp").unlink()

    bridge = ["Collektive.FlatBuffers.dll", "Collektive.Bridge.dll"]
    unity = [*bridge, "UnityEngine.dll", "Collektive.Unity.dll"]
    compile_one("UnityEngine.dll", [HEADLESS / "UnityEngine"], [], "-unsafe+")
    compile_one(bridge[1], [package / "Runtime/Bridge"], bridge[:1], "-unsafe+", f"@{package}/Runtime/Bridge/csc.rsp")
    compile_one("Collektive.Unity.dll", [package / "Runtime/Unity"], unity[:3])
    compile_one("UnityEditor.dll", [HEADLESS / "UnityEditor"], unity[2:3])
    compile_one("Collektive.Unity.Editor.dll", [package / "Editor"], [*unity, "UnityEditor.dll"])
    compile_one("Collektive.Player.exe", [HEADLESS / "Player", HEADLESS / "Replay"], [*unity, "Newtonsoft.Json.dll"], "-target:exe", f"-r:{MONO_POSIX}")
    for sample in sorted((package / "Samples~").iterdir()):
        if sample.is_dir():
            compile_one(f"{sample.name}.dll", [sample], unity)
