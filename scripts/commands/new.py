"""Creates a project that runs immediately, in the new folder NAME: a schema, a program with a test, a scene in C#, a scenario, an experiment,
and a Gradle build with which IDEs complete and check the Kotlin.

NAME consists of lower-case letters and digits. It becomes the namespace of the C# and the package of the Kotlin."""
import argparse
import os
import re
import tempfile
from pathlib import Path

from build import gradle, graph
from build.console import Failure
from build.places import ROOT

TEMPLATE = ROOT / "scripts/template"
# Namespaces that the generator refuses (ReservedNames.kt), and other namespaces of the package and of FlatBuffers.
RESERVED = frozenset("""
    abstract as assert async await base bool boolean break builder byte case catch char checked class collektive com const constant continue data decimal
    default delegate depth do double dynamic else enum event explicit extends extern false fault final finally fixed float for foreach fun global goto i if
    implements implicit import in init instanceof int interface internal is it items java javax jdk kotlin kotlinx lock long name nameof namespace native
    new nint nuint null object operator org out override pack package params partial place private protected public readonly record ref result return
    sbyte sealed short sizeof stackalloc standard static strictfp string struct sun super switch synchronized system target this throw throws transient
    true try typealias typeof types uint ulong unchecked union unity unsafe ushort using val var virtual void volatile when where while yield
""".split())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", type=_name)


def run(arguments: argparse.Namespace) -> int:
    folder = Path(arguments.name)
    if os.path.lexists(folder):
        raise Failure(f"new: '{folder}' already exists; choose another name")
    graph.build("runtime", "jvm_modules")
    # Creates the project atomically.
    with tempfile.TemporaryDirectory(prefix=f".{folder.name}.", dir=".") as work:
        project = Path(work) / folder.name
        _copy(project, folder.name)
        build = project / "build.gradle.kts"
        build.write_text(gradle.fill(build.read_text(encoding="utf-8"), f"{folder.name}.fbs", "programs"), encoding="utf-8")
        project.rename(folder)
    print(f"""{folder}: created. Next:
  ./collektive run {folder}/scenario.json --out out/{folder}
  ./collektive test {folder}
  ./collektive live {folder}/scenario.json
  ./collektive sweep {folder}/experiment.json --out out/{folder}-sweep""")
    return 0


def _name(text: str) -> str:
    if not re.fullmatch("[a-z][a-z0-9]*", text):
        raise argparse.ArgumentTypeError(f"'{text}' must consist of lower-case letters and digits, and begin with a letter")
    if text in RESERVED:
        raise argparse.ArgumentTypeError(f"'{text}' is a reserved word")
    return text


def _copy(project: Path, name: str) -> None:
    """Copies the template and replaces its names."""
    def fill(text: str) -> str:
        return text.replace("template", name).replace("Template", name.capitalize())
    for source in sorted(TEMPLATE.rglob("*")):
        if source.is_file():
            target = project / fill(str(source.relative_to(TEMPLATE)))
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(fill(source.read_text(encoding="utf-8")), encoding="utf-8")
