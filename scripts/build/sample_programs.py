"""Splits the jar with the programs of all samples into a library for each sample: `sample_programs.py OUT`.

Each library OUT/NAME.clkprograms is named after the sample's schema and contains the classes in its namespace. The same input always gives the same bytes.
"""
import hashlib
import re
import sys
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import version
from build.places import JVM, ROOT, SAMPLES_JAR

SAMPLES = ROOT / "unity/Samples~"
KOTLIN = JVM / "programs/src/main/kotlin"
SERVICE = "META-INF/services/org.collektive.frames.data.DataSchema"


def namespace(schema: Path) -> str:
    """Returns the namespace of a schema, which is also the package of its Kotlin."""
    match = re.search(r"^namespace ([\w.]+);", schema.read_text(), re.M)
    assert match
    return match[1]


def folder(schema: Path) -> Path:
    """Returns the folder of a sample's Kotlin."""
    return KOTLIN / namespace(schema).replace(".", "/")


def sources(schema: Path) -> list[Path]:
    """Returns the Kotlin files of a sample."""
    return sorted(folder(schema).glob("*.kt"))


def library(schema: Path, jar: zipfile.ZipFile) -> dict[str, bytes]:
    """Returns the entries of a sample's library by name."""
    package = namespace(schema)
    (service,) = [line for line in jar.read(SERVICE).decode().split() if line.startswith(package + ".")]
    names = [name for name in jar.namelist() if not name.endswith("/") and name.startswith(
        (package.replace(".", "/") + "/", f"META-INF/collektive/programs/{package}.", f"META-INF/collektive/{package}."))]
    marks = {"Manifest-Version": "1.0", "Collektive-Runtime": "builtIn", "Collektive-Version": version.product(), "Collektive-Sources": _hash(schema)}
    # A line in a jar's manifest is limited to 72 bytes.
    lines = [re.sub(r"(?<=.{72})(?=.)", "\r\n ", f"{name}: {value}", count=1) for name, value in marks.items()]
    return {"META-INF/MANIFEST.MF": "\r\n".join([*lines, "", ""]).encode(), SERVICE: (service + "\n").encode(),
            **{name: jar.read(name) for name in sorted(names)}}


def _hash(schema: Path) -> str:
    """Returns the hash by which the editor finds outdated libraries, as defined in SourceHash.kt."""
    digest = hashlib.sha256()
    for file in [schema, *sources(schema)]:
        digest.update(file.name.encode() + b"\0" + file.read_bytes().replace(b"\r", b"") + b"\0")
    return digest.hexdigest()


def write_all(out: Path) -> None:
    out.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(SAMPLES_JAR) as jar:
        for schema in SAMPLES.glob("*/*.fbs"):
            with zipfile.ZipFile(out / schema.with_suffix(".clkprograms").name, "w", zipfile.ZIP_DEFLATED) as target:
                for name, content in library(schema, jar).items():
                    target.writestr(zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED)


if __name__ == "__main__":
    write_all(Path(sys.argv[1]))
