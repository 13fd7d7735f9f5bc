"""Finds the JDKs of this machine."""
import os
import re
import subprocess
from functools import cache
from pathlib import Path

from build.console import Failure

OLDEST = 17
# Environment variables with options that every JVM reads.
OPTIONS = ("JAVA_TOOL_OPTIONS", "JDK_JAVA_OPTIONS", "_JAVA_OPTIONS")


def environment() -> dict[str, str]:
    """Returns the environment variables for a JVM whose results must not depend on the user's JVM options."""
    return {name: value for name, value in os.environ.items() if name not in OPTIONS}


def is_jdk(home: Path) -> bool:
    """Returns whether a folder is a JDK with a JVM library."""
    return (home / "lib/server/libjvm.so").exists() and os.access(home / "bin/javac", os.X_OK) and (home / "release").exists()


def feature_version(home: Path) -> int:
    """Returns a JDK's feature version, such as 25, or 0 if its release file does not contain one."""
    match = re.search(r'^JAVA_VERSION="(\d+)', (home / "release").read_text(), re.MULTILINE)
    return int(match[1]) if match else 0


@cache
def find_jdk() -> Path:
    """Returns the JDK that runs simulations. It is COLLEKTIVE_JAVA_HOME if that is set, and otherwise the newest JDK of this machine."""
    named = os.environ.get("COLLEKTIVE_JAVA_HOME")
    if named:
        home = Path(named)
        if not is_jdk(home):
            raise Failure(f"COLLEKTIVE_JAVA_HOME is not a JDK: '{named}' has no lib/server/libjvm.so, bin/javac and release")
        return _usable(home.resolve())
    found = _installed()
    if not found:
        raise Failure(f"no JDK {OLDEST} or newer found: install one (Debian: openjdk-17-jdk-headless) or set COLLEKTIVE_JAVA_HOME")
    return _usable(max(found, key=feature_version))


def _usable(home: Path) -> Path:
    """Returns the given JDK. Raises `Failure` if its JVM does not start with the options in the environment."""
    options = {name: os.environ[name] for name in OPTIONS if os.environ.get(name)}
    if options:
        result = subprocess.run([home / "bin/java", "-version"], stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
        if result.returncode != 0:
            reasons = [line for line in (result.stdout + result.stderr).splitlines() if not line.startswith(("Picked up", "NOTE: Picked up"))]
            raise Failure(f"the JVM does not start with {', '.join(f'{name}={value}' for name, value in options.items())}: {' '.join(reasons[:1])}")
    return home


def test_jdks() -> list[Path]:
    """Returns the JDKs on which the tests run. The last one is `find_jdk()`."""
    return [home for home in _installed() if home != find_jdk()] + [find_jdk()]


def _installed() -> list[Path]:
    folders = sorted(Path("/usr/lib/jvm").glob("*"))
    if os.environ.get("JAVA_HOME"):
        folders.append(Path(os.environ["JAVA_HOME"]))
    homes = dict.fromkeys(folder.resolve() for folder in folders if is_jdk(folder))
    return [home for home in homes if feature_version(home) >= OLDEST]
