"""Reads recorded runs with a JVM and without Unity."""
import os
from pathlib import Path

from build import processes
from build.console import Failure
from build.jdk import environment, find_jdk
from build.places import HOST_JAR, TOOLS_JAR

# The reader's exit code for an unusable record or jar.
UNUSABLE = 2
# The reader's exit code for a difference. A JVM that does not start exits with 1.
_DIFFERENT = 3
# The beginning of a record, up to the payload of its first chunk (docs/record-format.md).
_PREFIX_BYTES = 20
_MAX_HEAD_BYTES = 10_000


def read(command: str, record: str, *words: str | Path) -> int:
    """Runs a command of the reader, which prints its results itself. Returns the exit code: 0 no difference, 1 a difference, otherwise an error."""
    code = processes.call([find_jdk() / "bin/java", *flags(Path(record)), "-cp", f"{TOOLS_JAR}:{HOST_JAR}", "org.collektive.tools.record.RecordsKt",
                           command, record, *words], env=environment())
    if code == 1:
        raise Failure(f"{command}: the JVM has ended; its messages are above", UNUSABLE)
    return 1 if code == _DIFFERENT else code


def flags(record: Path) -> list[str]:
    """Returns the JVM options with which `Math` has the same results as in a recorded run. The reader reports an unusable file."""
    if not record.is_file() or not os.access(record, os.R_OK):
        return []
    with record.open("rb") as file:
        prefix = file.read(_PREFIX_BYTES)
        head = file.read(min(int.from_bytes(prefix[12:16], "little"), _MAX_HEAD_BYTES))
    return ["-XX:+UnlockDiagnosticVMOptions", "-XX:-UseLibmIntrinsic"] if b"maths=repeatable" in head.split(b"\n") else []
