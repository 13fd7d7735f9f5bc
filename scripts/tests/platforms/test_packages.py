"""What ./collektive package --all publishes: its size, and that it can be made again. Needs the native libraries of all platforms."""
import hashlib
import os
import shutil
import subprocess
import tarfile

import pytest

from build.places import BUILD, COLLEKTIVE

# Those that were built.
PLATFORMS = os.environ["COLLEKTIVE_PLATFORMS"].split()
MEGABYTE = 1_000_000

pytestmark = pytest.mark.skipif(len(PLATFORMS) < 5, reason="only ./collektive test platforms builds all")


def pack(step, folder, *options):
    """Makes a package anew: the path of its archive."""
    work = os.path.join(folder, "work")
    os.makedirs(work)
    result = subprocess.run([COLLEKTIVE, "step", step, work, folder, *options], stdout=subprocess.PIPE, text=True, check=True)
    shutil.rmtree(work)
    return result.stdout.strip()


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


@pytest.fixture(scope="module")
def core(tmp_path_factory):
    subprocess.run([COLLEKTIVE, "step", "build_all_platforms"], check=True)
    return pack("pack_core", str(tmp_path_factory.mktemp("core")), "", "yes")


def test_the_package_of_all_platforms_has_less_than_15_mb(core) -> None:
    assert os.path.getsize(core) < 15 * MEGABYTE


def test_it_has_each_native_library_and_what_makes_code_in_the_editors(core) -> None:
    with tarfile.open(core) as archive:
        names = {name.removeprefix("package/unity/") for name in archive.getnames()}
    for platform in PLATFORMS:
        library = {"win": "collektive_shim.dll", "mac": "libcollektive_shim.dylib"}.get(platform[:3], "libcollektive_shim.so")
        assert {f"Runtime/Plugins/{platform}/{library}", f"Runtime/Plugins/{platform}/{library}.meta"} <= names
    assert {"Tools~/linux-x64/flatc", "Tools~/win-x64/flatc.exe", "Tools~/mac-arm64/flatc"} <= names


def test_the_same_sources_give_the_same_bytes(core, tmp_path) -> None:
    assert digest(pack("pack_core", str(tmp_path), "", "yes")) == digest(core)


def test_a_jvm_that_is_cut_again_gives_the_same_bytes(tmp_path) -> None:
    jdk = subprocess.run([COLLEKTIVE, "step", "find_jdk"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    if subprocess.run([COLLEKTIVE, "step", "jdk_version", jdk], stdout=subprocess.PIPE, text=True, check=True).stdout.strip() != "25":
        pytest.skip("only a JDK 25 links JVMs of version 25")
    archives = []
    for time in "first", "second":
        stamp = os.path.join(BUILD, "stamp/cut-linux-arm64")
        if os.path.exists(stamp):
            os.remove(stamp)
        archives.append(digest(pack("pack_jvm", str(tmp_path / time), "linux-arm64")))
    assert archives[0] == archives[1]
