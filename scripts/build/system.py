"""System packages: the tools that the build needs, and their installation on Debian and Ubuntu."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from build import jdk
from build.console import Failure, logged, say
from build.places import BUILD

OLDEST_PYTHON = (3, 11)


class Tool(NamedTuple):
    """A command of which one of several names must be new enough, and the Debian packages that provide it."""

    commands: tuple[str, ...]
    oldest: str
    packages: tuple[str, ...]


TOOLS = (
    Tool(("git",), "2.30", ("git",)),
    Tool(("cc",), "10", ("gcc",)),
    Tool(("c++",), "10", ("g++",)),
    Tool(("cmake",), "3.25", ("cmake",)),
    Tool(("ninja",), "1.11", ("ninja-build",)),
    Tool(("javac",), "17", ("default-jdk-headless",)),
    Tool(("mvn",), "3.6.3", ("maven",)),
    Tool(("cargo", "cargo-1.85"), "1.85", ("cargo", "cargo-web", "cargo-1.85")),
    Tool(("node",), "18", ("nodejs",)),
    Tool(("npm",), "8", ("npm",)),
    Tool(("python3",), ".".join(map(str, OLDEST_PYTHON)), ("python3",)),
    Tool(("mcs",), "6.8", ("mono-mcs",)),
    Tool(("mono-sgen",), "6.8", ("mono-devel",)),
    Tool(("mono-boehm",), "6.8", ("mono-runtime-boehm",)),
)
MONO_POSIX = Path("/usr/lib/mono/4.5/Mono.Posix.dll")
# Libraries without a command, and their Debian packages.
FILES = {MONO_POSIX: "libmono-posix4.0-cil"}
# Needed by the C# tests only; Debian 13 has no package of it.
NUNIT = Path("/usr/lib/cli/nunit.framework-2.6.3/nunit.framework.dll")


class Missing(NamedTuple):
    """A missing or outdated tool: the Debian package that provides it, and what is wrong."""

    package: str
    reason: str


def setup_system() -> None:
    """Installs missing system packages if this is root on Debian or Ubuntu.

    Raises `Failure` with the list of what is missing otherwise. Versions are checked again only if a tool was replaced, because that
    takes two seconds.
    """
    stamp = BUILD / "stamp/system"
    if stamp.exists() and stamp.read_text() == _state():
        return
    missing = find_missing()
    if missing and may_install():
        logged("package-lists", ["apt-get", "update"])
        # Before the update, apt on a fresh system does not know which package is new enough.
        install([package for package, _ in find_missing()], "system-packages")
        missing = find_missing()
        if missing:
            raise Failure("still missing although the packages are installed:\n" + _reasons(missing))
    elif missing:
        packages = " ".join(dict.fromkeys(package for package, _ in missing))
        raise Failure(f"these tools are missing or too old:\n{_reasons(missing)}\n"
                      f"Install them; on Debian or Ubuntu as root: apt-get install {packages}")
    stamp.parent.mkdir(parents=True, exist_ok=True)
    stamp.write_text(_state())


def find_missing() -> list[Missing]:
    """Returns the tools that are missing or too old."""
    missing = []
    for tool in TOOLS:
        if find_tool(tool.commands[0]) is None:
            missing.append(Missing(_package_for(tool), f"{_found(tool.commands[0])}; {tool.oldest} or newer is needed"))
    # Debian's python3 cannot create virtual environments without this package.
    if subprocess.run(["python3", "-I", "-c", "import ensurepip"], capture_output=True).returncode != 0:
        missing.append(Missing("python3-venv", "python3 has no module ensurepip"))
    return missing + [Missing(package, f"{file} is missing") for file, package in FILES.items() if not file.exists()]


def find_tool(name: str) -> str | None:
    """Returns the path of the first command of a tool that is new enough."""
    tool = next(tool for tool in TOOLS if tool.commands[0] == name)
    for command in tool.commands:
        path = shutil.which(command)
        if path and _at_least(tool.oldest, version_of(path)):
            return path
    return None


def version_of(command: str) -> str:
    """Returns the version that a command prints, or nothing."""
    match = re.search(r"\d+(\.\d+)*", re.sub(r"\x1b\[[0-9;]*m", "", _version_output(command).stdout))
    return match[0] if match else ""


def _version_output(command: str) -> subprocess.CompletedProcess[str]:
    # A JVM that rejects the user's options is not an outdated one.
    environment = {name: value for name, value in os.environ.items() if name not in jdk.OPTIONS}
    return subprocess.run([command, "--version"], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")


def _found(name: str) -> str:
    """Describes a command that cannot be used."""
    command = shutil.which(name)
    if not command:
        return f"{name} is missing"
    version = version_of(command)
    if version:
        return f"{command} has version {version}"
    # Such as rustup's without a default toolchain.
    errors = _version_output(command).stderr.strip()
    return f"{command} --version fails" + (f": {errors.splitlines()[0]}" if errors else "")


def may_install() -> bool:
    """Reports whether this process can install Debian packages."""
    return os.geteuid() == 0 and shutil.which("apt-get") is not None


def install(packages: list[str], log: str) -> None:
    """Installs Debian packages."""
    logged(log, ["apt-get", "install", "-y", "--no-install-recommends", *packages], env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})


def setup_nunit() -> None:
    """Installs the framework of the C# tests where the system has a package of it."""
    if NUNIT.exists():
        return
    if not may_install():
        raise Failure(f"{NUNIT} is missing. Install it; on Debian 12 or Ubuntu as root: apt-get install libnunit-cil-dev")
    logged("package-lists", ["apt-get", "update"])
    if candidate("libnunit-cil-dev"):
        install(["libnunit-cil-dev"], "nunit")
    else:
        say("this system has no package of NUnit 2.6: the C# tests are left out")


def candidate(package: str) -> str:
    """Returns the version of a package that apt would install, or nothing."""
    if not shutil.which("apt-cache"):
        return ""
    output = subprocess.run(["apt-cache", "policy", package], capture_output=True, text=True).stdout
    match = re.search(r"^  Candidate: (\d.*)", output, re.MULTILINE)
    return match[1] if match else ""


def _package_for(tool: Tool) -> str:
    """Returns the first package of a tool that apt has in a version that is new enough, or the first one."""
    for package in tool.packages:
        version = re.sub(r"^\d+:", "", candidate(package))
        if version and _at_least(tool.oldest, version):
            return package
    return tool.packages[0]


def _at_least(oldest: str, version: str) -> bool:
    return _numbers(version) >= _numbers(oldest) if version else False


def _numbers(version: str) -> list[int]:
    match = re.match(r"\d+(\.\d+)*", version)
    return [int(number) for number in match[0].split(".")] if match else []


def _reasons(missing: list[Missing]) -> str:
    return "\n".join(reason for _, reason in missing)


def _state() -> str:
    """Describes the tools as they are now, without starting them."""
    lines = [repr((TOOLS, FILES)), sys.version]
    for path in [shutil.which(command) for tool in TOOLS for command in tool.commands] + [str(file) for file in FILES]:
        try:
            status = os.stat(path or "")
            lines.append(f"{path} {status.st_size} {status.st_mtime_ns}")
        except OSError:
            lines.append(f"{path} missing")
    return "\n".join(lines)
