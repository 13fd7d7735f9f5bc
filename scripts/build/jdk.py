"""Java Development Kits of this machine."""
import os
import re
from functools import cache
from pathlib import Path

from build.console import Failure

OLDEST = 17


def is_jdk(home: Path) -> bool:
    """Reports whether a folder is a JDK that can be started in a process."""
    return (home / "lib/server/libjvm.so").exists() and os.access(home / "bin/javac", os.X_OK) and (home / "release").exists()


def feature_version(home: Path) -> int:
    """Returns a JDK's feature version, such as 25, or 0 if its release file does not state one."""
    match = re.search(r'^JAVA_VERSION="(\d+)', (home / "release").read_text(), re.MULTILINE)
    return int(match[1]) if match else 0


@cache
def find_jdk() -> Path:
    """Returns the JDK that runs simulations: the one that COLLEKTIVE_JAVA_HOME names, or the newest one."""
    named = os.environ.get("COLLEKTIVE_JAVA_HOME")
    if named:
        home = Path(named)
        if not is_jdk(home):
            raise Failure(f"COLLEKTIVE_JAVA_HOME is not a JDK: '{named}' has no lib/server/libjvm.so, bin/javac and release")
        return home.resolve()
    found = _installed()
    if not found:
        raise Failure(f"no JDK {OLDEST} or newer found: install one (Debian: openjdk-17-jdk-headless) or set COLLEKTIVE_JAVA_HOME")
    return max(found, key=feature_version)


def test_jdks() -> list[Path]:
    """Returns the JDKs that tests run on: those of this machine, and last the one that runs simulations."""
    return [home for home in _installed() if home != find_jdk()] + [find_jdk()]


def _installed() -> list[Path]:
    folders = sorted(Path("/usr/lib/jvm").glob("*"))
    if os.environ.get("JAVA_HOME"):
        folders.append(Path(os.environ["JAVA_HOME"]))
    homes = dict.fromkeys(folder.resolve() for folder in folders if is_jdk(folder))
    return [home for home in homes if feature_version(home) >= OLDEST]
