"""Finds the system packages that the build needs, and installs them on Debian and Ubuntu."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from build import jdk
from build.console import Failure, print_progress, run_logged
from build.places import BUILD

OLDEST_PYTHON = (3, 11)


class Tool(NamedTuple):
    """A required tool: its command with alternative names, its oldest supported version, and the Debian packages that provide it."""

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
# Required libraries, and the Debian packages that provide them.
FILES = {MONO_POSIX: "libmono-posix4.0-cil"}
# Only the C# tests need NUnit. Debian 13 has no package for it.
NUNIT = Path("/usr/lib/cli/nunit.framework-2.6.3/nunit.framework.dll")


class Missing(NamedTuple):
    """A missing or outdated tool: its Debian package and the reason."""

    package: str
    reason: str


def setup_system() -> None:
    """Installs missing system packages if the user is root on Debian or Ubuntu, and otherwise raises `Failure` with a list of the missing packages.

    Checking all versions takes two seconds, so this function does it only if a tool has changed.
    """
    stamp = BUILD / "stamp/system"
    if stamp.exists() and stamp.read_text() == _state():
        return
    missing = find_missing()
    if missing and can_install():
        run_logged("package-lists", ["apt-get", "update"])
        # The packages are determined again, because apt knows their versions only after the update.
        install([package for package, _ in find_missing()], "system-packages")
        missing = find_missing()
        if missing:
            raise Failure("these tools are still missing or too old after installing their packages:\n" + _reasons(missing))
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
            missing.append(Missing(_package_for(tool), f"{_describe(tool.commands[0])}; {tool.oldest} or newer is needed"))
    # Without this package, Debian's python3 cannot create virtual environments.
    if subprocess.run(["python3", "-I", "-c", "import ensurepip"], capture_output=True).returncode != 0:
        missing.append(Missing("python3-venv", "python3 has no module ensurepip"))
    return missing + [Missing(package, f"{file} is missing") for file, package in FILES.items() if not file.exists()]


def find_tool(name: str) -> str | None:
    """Returns the path of the tool's first command that is new enough, or None if all are missing or too old."""
    tool = next(tool for tool in TOOLS if tool.commands[0] == name)
    for command in tool.commands:
        path = shutil.which(command)
        if path and _at_least(tool.oldest, version_of(path)):
            return path
    return None


def version_of(command: str) -> str:
    """Returns the version that a command prints, or an empty string."""
    match = re.search(r"\d+(\.\d+)*", re.sub(r"\x1b\[[0-9;]*m", "", _version_output(command).stdout))
    return match[0] if match else ""


def _version_output(command: str) -> subprocess.CompletedProcess[str]:
    # If a JVM rejected these options, it would not print its version and would appear outdated.
    return subprocess.run([command, "--version"], env=jdk.environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")


def _describe(name: str) -> str:
    """Returns the reason why a command cannot be used."""
    command = shutil.which(name)
    if not command:
        return f"{name} is missing"
    version = version_of(command)
    if version:
        return f"{command} has version {version}"
    # One example is rustup without a default toolchain.
    errors = _version_output(command).stderr.strip()
    return f"{command} --version fails" + (f": {errors.splitlines()[0]}" if errors else "")


def can_install() -> bool:
    """Returns whether this process can install Debian packages."""
    return os.geteuid() == 0 and shutil.which("apt-get") is not None


def install(packages: list[str], log: str) -> None:
    """Installs Debian packages."""
    run_logged(log, ["apt-get", "install", "-y", "--no-install-recommends", *packages], env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})


def setup_nunit() -> None:
    """Installs NUnit if the system has a package for it."""
    if NUNIT.exists():
        return
    if not can_install():
        raise Failure(f"{NUNIT} is missing. Install it; on Debian 12 or Ubuntu as root: apt-get install libnunit-cil-dev")
    run_logged("package-lists", ["apt-get", "update"])
    if candidate_version("libnunit-cil-dev"):
        install(["libnunit-cil-dev"], "nunit")
    else:
        print_progress("skipping the C# tests: this system has no package for NUnit 2.6")


def candidate_version(package: str) -> str:
    """Returns the version of a package that apt would install, or an empty string."""
    if not shutil.which("apt-cache"):
        return ""
    output = subprocess.run(["apt-cache", "policy", package], capture_output=True, text=True).stdout
    match = re.search(r"^  Candidate: (\d.*)", output, re.MULTILINE)
    return match[1] if match else ""


def _package_for(tool: Tool) -> str:
    """Returns the first package of a tool that apt offers in a sufficient version, or the first package if apt offers none."""
    for package in tool.packages:
        version = re.sub(r"^\d+:", "", candidate_version(package))
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
    """Returns a string that changes whenever a tool changes. Does not start the tools."""
    lines = [repr((TOOLS, FILES)), sys.version]
    for path in [shutil.which(command) for tool in TOOLS for command in tool.commands] + [str(file) for file in FILES]:
        try:
            status = os.stat(path or "")
            lines.append(f"{path} {status.st_size} {status.st_mtime_ns}")
        except OSError:
            lines.append(f"{path} missing")
    return "\n".join(lines)
