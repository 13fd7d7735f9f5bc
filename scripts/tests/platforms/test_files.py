"""Tests the exports, dependencies and headers of the native libraries. It reads the files, because libraries for macOS cannot be loaded here."""
import os
import re
import struct
import subprocess

import pytest

from build.places import ROOT

CROSS = os.environ["COLLEKTIVE_CROSS"]
# The platforms whose libraries are built.
PLATFORMS = os.environ["COLLEKTIVE_PLATFORMS"].split()
MAC = {"mac-x64": (0x01000007, (10, 13)), "mac-arm64": (0x0100000C, (11, 0))}
LINUX = {"linux-x64": "X86-64", "linux-arm64": "AArch64"}


def library(platform: str) -> str:
    name = {"win": "collektive_shim.dll", "mac": "libcollektive_shim.dylib"}.get(platform[:3], "libcollektive_shim.so")
    return os.path.join(CROSS, platform, name)


def functions() -> set[str]:
    """Returns the functions in the public headers, and the function that Java calls."""
    found = {"Java_org_collektive_host_Main_serve"}
    for header in ("collektive_shim.h", "collektive_neighbours.h"):
        with open(os.path.join(ROOT, "native-shim/include", header)) as file:
            found |= set(re.findall(r"^CLK_\w*API .*?\b(clk_\w+)\(", file.read(), re.M))
    return found


def output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class MachO:
    """A 64-bit Mach-O file: its processor and load commands."""

    def __init__(self, path: str) -> None:
        with open(path, "rb") as file:
            self.bytes = file.read()
        magic, self.processor, _, _, count = struct.unpack_from("<5I", self.bytes)
        assert magic == 0xFEEDFACF
        self.commands: list[tuple[int, bytes]] = []
        at = 32
        for _ in range(count):
            kind, size = struct.unpack_from("<2I", self.bytes, at)
            self.commands.append((kind, self.bytes[at:at + size]))
            at += size

    def command(self, sought: int) -> bytes:
        """Returns the first load command of a kind, or empty bytes if the file has none."""
        return next((body for kind, body in self.commands if kind == sought), b"")

    def install_name(self) -> str:
        body = self.command(0xD)
        return body[struct.unpack_from("<I", body, 8)[0]:].split(b"\0")[0].decode()

    def oldest_system(self) -> tuple[int, int]:
        build, minimum = self.command(0x32), self.command(0x24)
        version: int = struct.unpack_from("<I", build, 12)[0] if build else struct.unpack_from("<I", minimum, 8)[0]
        return version >> 16, version >> 8 & 0xFF

    def exports(self) -> set[str]:
        """Returns the names of the symbols that the library exports."""
        symbols, count, strings, _ = struct.unpack_from("<4I", self.command(0x2), 8)
        found = set()
        for i in range(count):
            name, kind, section = struct.unpack_from("<IBB", self.bytes, symbols + 16 * i)
            if kind & 0x01 and not kind & 0x10 and kind & 0x0E == 0x0E and section:
                found.add(self.bytes[strings + name:].split(b"\0", 1)[0].decode()[1:])
        return found


@pytest.mark.parametrize("platform", [platform for platform in MAC if platform in PLATFORMS])
def test_the_library_of_macos_has_an_install_name_and_a_minimum_version(platform: str) -> None:
    file = MachO(library(platform))
    processor, system = MAC[platform]
    assert file.processor == processor
    assert file.oldest_system() == system
    assert file.install_name() == "@rpath/libcollektive_shim.dylib"
    # Names with an underscore are ignored, because the linker adds them.
    assert {name for name in file.exports() if not name.startswith("_")} == functions()
    # The library for Apple silicon must be signed, because macOS loads only signed code there.
    assert bool(file.command(0x1D)) == (platform == "mac-arm64")


@pytest.mark.parametrize("platform", [platform for platform in MAC if platform in PLATFORMS])
def test_the_tests_of_macos_are_compiled(platform: str) -> None:
    assert MachO(os.path.join(CROSS, platform, "test/shim_test")).processor == MAC[platform][0]


@pytest.mark.parametrize("platform", [platform for platform in LINUX if platform in PLATFORMS])
def test_the_library_of_linux_runs_with_glibc_2_17(platform: str) -> None:
    assert LINUX[platform] in output("readelf", "-h", library(platform))
    versions = {tuple(map(int, version.split("."))) for version in re.findall(r"GLIBC_([\d.]+)", output("readelf", "-V", library(platform)))}
    assert versions and max(versions) <= (2, 17)
    symbols = re.findall(r"GLOBAL DEFAULT +\d+ (\w+)$", output("readelf", "--dyn-syms", "-W", library(platform)), re.M)
    assert set(symbols) == functions()


@pytest.mark.skipif("win-x64" not in PLATFORMS, reason="only ./collektive test platforms builds it")
def test_the_library_of_windows_needs_only_windows() -> None:
    dump = output("objdump", "-p", library("win-x64"))
    assert set(re.findall(r"\b((?:clk|Java)_\w+)$", dump, re.M)) == functions()
    needed = {name.lower() for name in re.findall(r"DLL Name: (\S+)", dump)}
    assert needed and all(re.fullmatch(r"kernel32\.dll|ntdll\.dll|api-ms-win-.*\.dll", name) for name in needed)
