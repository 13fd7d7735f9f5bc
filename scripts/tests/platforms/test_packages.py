"""Tests the size and the reproducibility of the packages that ./collektive package --all builds. It needs the native libraries of all platforms."""
import hashlib
import os
import tarfile
from pathlib import Path

import pytest

from build import package
from build.jdk import feature_version, find_jdk
from build.places import BUILD

# The platforms whose libraries are built.
PLATFORMS = os.environ["COLLEKTIVE_PLATFORMS"].split()
MEGABYTE = 1_000_000

pytestmark = pytest.mark.skipif(len(PLATFORMS) < 5, reason="only ./collektive test platforms builds all")


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def core(tmp_path_factory: pytest.TempPathFactory) -> Path:
    package.build_parts(all_platforms=True)
    return package.core(tmp_path_factory.mktemp("work"), tmp_path_factory.mktemp("core"), all_platforms=True)


def test_the_package_for_all_platforms_is_smaller_than_15_mb(core: Path) -> None:
    assert os.path.getsize(core) < 15 * MEGABYTE


def test_the_package_contains_all_native_libraries_and_code_generators(core: Path) -> None:
    with tarfile.open(core) as archive:
        names = {name.removeprefix("package/unity/") for name in archive.getnames()}
    assert not any(name.startswith("Runtime/Plugins/linux-arm64") for name in names), "Linux players before 6000.5 can contain only one library"
    for platform in set(PLATFORMS) - {"linux-arm64"}:
        library = {"win": "collektive_shim.dll", "mac": "libcollektive_shim.dylib"}.get(platform[:3], "libcollektive_shim.so")
        assert {f"Runtime/Plugins/{platform}/{library}", f"Runtime/Plugins/{platform}/{library}.meta"} <= names
    assert {"Tools~/linux-x64/flatc", "Tools~/win-x64/flatc.exe", "Tools~/mac-arm64/flatc"} <= names


def test_the_same_sources_give_the_same_bytes(core: Path, tmp_path: Path) -> None:
    assert digest(package.core(tmp_path / "work", tmp_path, all_platforms=True)) == digest(core)


@pytest.mark.skipif(feature_version(find_jdk()) != 25, reason="only a JDK 25 links JVMs of version 25")
def test_building_a_jvm_image_again_gives_the_same_bytes(tmp_path: Path) -> None:
    archives = []
    for time in "first", "second":
        (BUILD / "stamp/cut-linux-arm64").unlink(missing_ok=True)
        archives.append(package.jvm(tmp_path / time, tmp_path / time, "linux-arm64"))
    assert digest(archives[0]) == digest(archives[1])
    with tarfile.open(archives[0]) as archive:
        assert {"package/Plugins/linux-arm64/libcollektive_shim.so", "package/Plugins/linux-arm64/libcollektive_shim.so.meta"} <= set(archive.getnames())
