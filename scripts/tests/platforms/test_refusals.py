"""Tests the errors about JVMs of another platform and about JVMs at an unsupported path, with real JVMs."""
import json
import os
import subprocess
from pathlib import Path

import pytest

from build.places import BUILD

CROSS = os.environ["COLLEKTIVE_CROSS"]
# The command that runs java, for each platform that can run on this machine.
JAVA = json.loads(os.environ["COLLEKTIVE_JAVA_COMMANDS"])
NAMES = {"win-x64": "Windows on x86_64", "linux-x64": "Linux on x86_64", "linux-arm64": "Linux on aarch64"}
HERE = os.environ["COLLEKTIVE_JDK"]
# No Windows code page contains both a Japanese and a German character.
FOREIGN = "Programmgröße 場"


def start(platform: str, home: str, case: str = "options_that_make_the_jvm_print", **variables: str) -> tuple[int, str]:
    """Starts a JVM with the platform's native library. Returns the exit code, which is 0 if the JVM has started, and the output."""
    program = os.path.join(CROSS, platform, "shim_test.exe" if platform == "win-x64" else "test/shim_test")
    environment = {**os.environ, "WINEPREFIX": os.path.join(BUILD, "wine"), "WINEDEBUG": "-all", "CLK_TEST_JAVA_HOME": home, **variables}
    result = subprocess.run([*JAVA[platform][:-1], program, case], env=environment, cwd=os.path.dirname(program), stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, timeout=120)
    return result.returncode, result.stdout.decode(errors="replace")


def home_of(platform: str) -> str:
    """Returns the JRE that the tests of the library use."""
    prepared = os.path.join(CROSS, "jre-" + platform)
    return prepared if os.path.exists(prepared) else os.path.dirname(os.path.dirname(JAVA[platform][-1]))


def without_release(home: str, folder: Path) -> str:
    """Copies the JVM without the file `release`, which names the platform."""
    copy = os.path.join(folder, "home")
    os.mkdir(copy)
    for name in os.listdir(home):
        if name != "release":
            os.symlink(os.path.join(home, name), os.path.join(copy, name))
    return copy


def others(platform: str) -> list[str]:
    """Returns the available JVMs of other platforms."""
    return ([] if platform == "linux-x64" else [HERE]) + [home_of(other) for other in JAVA if other != platform]


@pytest.mark.parametrize("platform", JAVA)
def test_a_jvm_of_another_platform_is_rejected_with_the_required_platform(platform: str, tmp_path: Path) -> None:
    for number, home in enumerate(others(platform)):
        folder = tmp_path / str(number)
        folder.mkdir()
        for place in (home, without_release(home, folder)):
            code, text = start(platform, place)
            print(text)
            assert code == 1
            assert "CLK_JVM_NOT_FOUND" in text
            assert NAMES[platform] in text.split("last error:")[1]


@pytest.mark.parametrize("platform", [platform for platform in JAVA if platform == "win-x64"])
def test_windows_rejects_a_jvm_path_outside_its_code_page(platform: str, tmp_path: Path) -> None:
    home = tmp_path / FOREIGN
    home.symlink_to(home_of(platform))
    code, text = start(platform, str(home))
    print(text)
    assert code == 1
    assert "the Windows code page cannot encode" in text and FOREIGN in text and "use an ASCII path" in text


@pytest.mark.parametrize("platform", [platform for platform in JAVA if platform != "win-x64"])
def test_linux_accepts_any_jvm_path_that_the_locale_can_represent(platform: str, tmp_path: Path) -> None:
    home = tmp_path / FOREIGN
    home.symlink_to(home_of(platform))
    assert start(platform, str(home), LC_ALL="C.UTF-8")[0] == 0
    code, text = start(platform, str(home), LC_ALL="C")
    assert code == 1
    assert "the locale of the process cannot encode" in text and "set LC_ALL=C.UTF-8" in text
