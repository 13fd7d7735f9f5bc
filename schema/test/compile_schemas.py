"""Compiles generated C# and Kotlin, and returns the command lines of the test programs."""
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from build import csharp, managed, projects
from build.jdk import find_jdk
from build.places import BUILD, CSHARP, FLATC, GENERATOR_JAR, HOST_JAR, JVM, LIBRARY_JAR, ROOT

JAVA = str(find_jdk() / "bin/java")
# The programs are part of the tests of the modules generator and frames.
GENERATE_ALL = [JAVA, "-cp", f"{JVM}/generator/target/test-classes:{GENERATOR_JAR}", "org.collektive.generator.GenerateAll", str(FLATC),
                 str(ROOT / "schema")]
ASSEMBLIES = ("Collektive.FlatBuffers.dll", "Collektive.Bridge.dll", "UnityEngine.dll", "Collektive.Unity.dll")
REFERENCES = [f"-r:{CSHARP}/{name}" for name in ASSEMBLIES]


def round_trip_csharp(program: Path = CSHARP / "RoundTrip.exe") -> list[str]:
    """Returns the command line of the C# program."""
    return [str(word) for word in managed.command("mono-sgen", program)]


def round_trip_kotlin(classes: Path) -> list[str]:
    """Returns the command line of the Kotlin program."""
    return [JAVA, "-cp", f"{classes}:{JVM}/frames/target/test-classes:{HOST_JAR}", "org.collektive.frames.data.RoundTrip"]


def compile_test_schemas() -> Path:
    """Returns the folder with classes of the test schemas."""
    classes = BUILD / "roundtrip"
    generated = classes / "generated"
    shutil.rmtree(classes, ignore_errors=True)
    for schema in sorted((ROOT / "schema/test").glob("*.fbs")):
        subprocess.run(projects.generator(schema, "--jvm", generated), check=True)
        subprocess.run([FLATC, "--java", "--gen-object-api", "--gen-all", "--no-warnings", "--java-package-prefix", "objects", "-I", ROOT / "schema",
                        "-o", generated, schema], check=True)
    _compile_jvm(generated, classes)
    return classes


def compile_generated(folder: Path) -> str:
    """Compiles the code that fuzz.py has generated in a folder. Returns the compilers' errors, or an empty string."""
    try:
        sources = csharp.sources([folder / "csharp"])
        _run(csharp.command(folder / "TestSchemas.dll", sources, [*csharp.symbols(), *REFERENCES]))
        for name in ("RoundTrip.exe", *ASSEMBLIES):
            shutil.copy(CSHARP / name, folder)
        _compile_jvm(folder / "jvm", folder / "classes")
    except subprocess.CalledProcessError as error:
        return str(error.stdout) or f"the compiler ended with code {error.returncode}"
    return ""


def _compile_jvm(generated: Path, classes: Path) -> None:
    """Compiles the Java and then the Kotlin of a folder into a folder of classes."""
    classes.mkdir(parents=True, exist_ok=True)
    _run([find_jdk() / "bin/javac", "--release", "17", "-nowarn", "-proc:none", "-cp", HOST_JAR, "-d", classes, *sorted(generated.rglob("*.java"))])
    _run([*projects.compiler_jvm(), "org.jetbrains.kotlin.cli.jvm.K2JVMCompiler", "-no-stdlib", "-no-reflect",
          "-jvm-target", "17", "-cp", f"{HOST_JAR}:{LIBRARY_JAR}:{classes}", "-d", classes, generated])
    shutil.copytree(generated / "META-INF", classes / "META-INF", dirs_exist_ok=True)


def _run(command: Sequence[str | Path]) -> None:
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=True)
