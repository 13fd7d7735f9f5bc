"""Tests the errors about the environment of a command, in a checkout without build outputs."""
import argparse
import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from checkout import Checkout

import collektive
from build import experiments
from build.places import ROOT


@pytest.mark.parametrize("character", ":;,\"$`\\#")
def test_a_checkout_path_that_the_build_tools_do_not_support_is_rejected(checkout: Checkout, character: str) -> None:
    checkout.root = checkout.root.rename(checkout.root.with_name(f"a{character}b"))
    command = checkout.start_command("clean")
    errors = command.communicate()[1]
    assert command.returncode == 1
    assert f"a{character}b', contains '{character}', which the build tools do not support" in errors


@pytest.mark.parametrize("words, code", [(("diff", "a", "b"), 2), (("replay", "a"), 2), (("run", "a"), 1)])
@pytest.mark.skipif(os.geteuid() != 0, reason="only root can mount")
def test_a_read_only_checkout_is_a_one_line_error_and_not_a_difference(checkout: Checkout, words: tuple[str, ...], code: int) -> None:
    mount = 'mount --bind "$1" "$1" && mount -o remount,ro,bind "$1" || exit 99; command=$1/collektive; shift; exec "$command" "$@"'
    result = subprocess.run(["unshare", "--mount", "sh", "-c", mount, "sh", str(checkout.root), *words], capture_output=True, text=True)
    if result.returncode == 99 or "unshare:" in result.stderr:
        pytest.skip("mounting is not permitted")
    assert result.returncode == code
    assert result.stderr.splitlines() == [f"collektive: '{checkout.root}/build': Read-only file system: the command must be able to write to its checkout; "
                                          "use a checkout that you own"]


@pytest.mark.parametrize("number", [errno.EACCES, errno.EPERM])
def test_a_checkout_of_another_user_is_a_one_line_error(number: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def fail(_: argparse.Namespace) -> int:
        raise OSError(number, os.strerror(number), str(ROOT / "build/stamp"))

    monkeypatch.setattr(collektive, "check_environment", lambda: None)
    assert collektive.run_command(argparse.Namespace(run=fail, error_code=2)) == 2
    assert capsys.readouterr().err == (f"collektive: '{ROOT}/build/stamp': {os.strerror(number)}: the command must be able to write to its checkout; "
                                       "use a checkout that you own\n")


def test_a_folder_that_is_not_a_jdk_is_reported_before_anything_is_fetched(checkout: Checkout) -> None:
    command = [str(checkout.root / "collektive"), "plot", "sweep"]
    result = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "COLLEKTIVE_JAVA_HOME": "/nope"})
    assert result.returncode == 1
    assert result.stderr == "collektive: COLLEKTIVE_JAVA_HOME is not a JDK: '/nope' has no lib/server/libjvm.so, bin/javac and release\n"


def test_a_reader_that_closes_the_output_ends_the_command_silently(checkout: Checkout) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    result = subprocess.run([checkout.root / "collektive", "--help"], stdout=writer, stderr=subprocess.PIPE, text=True)
    os.close(writer)
    assert (result.returncode, result.stderr) == (-signal.SIGPIPE, "")


def test_commands_ignore_the_module_path_of_the_user(checkout: Checkout, tmp_path: Path) -> None:
    for module in ("argparse", "collections", "sitecustomize"):
        (tmp_path / f"{module}.py").write_text(f"open({str(tmp_path / 'executed')!r}, 'w')")
    result = subprocess.run([checkout.root / "collektive", "--help"], cwd=tmp_path, capture_output=True, text=True,
                            env={**os.environ, "PYTHONPATH": f".:{tmp_path}"})
    assert (result.returncode, result.stderr) == (0, "")
    assert not (tmp_path / "executed").exists()


def test_without_a_search_path_python_knows_its_own_path(checkout: Checkout) -> None:
    (checkout.root / "scripts/collektive.py").write_text("import sys; print(sys.executable)")
    environment = {name: value for name, value in os.environ.items() if name != "PATH"}
    result = subprocess.run(["/bin/sh", checkout.root / "collektive"], capture_output=True, text=True, env=environment)
    assert os.access(result.stdout.strip(), os.X_OK), result.stderr


@pytest.mark.parametrize(("name", "given", "expected"), [("LC_ALL", "de_DE.UTF-8", "C.UTF-8"), ("TZ", "Asia/Tokyo", "UTC")])
def test_commands_use_the_same_locale_and_time_zone_for_any_user(name: str, given: str, expected: str, checkout: Checkout) -> None:
    program = f"import collektive, os; collektive.check_environment(); print(os.environ['{name}'])"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=checkout.root / "scripts",
                            env={**os.environ, name: given})
    assert result.stdout == f"{expected}\n", result.stderr


@pytest.mark.parametrize("options", ["--debug -O=-float32", '--debug -"O=-float32"', r"\-O=-float32"])
def test_mono_has_no_other_optimizations(options: str, checkout: Checkout) -> None:
    result = subprocess.run([checkout.root / "collektive", "run", "x.json"], capture_output=True, text=True,
                            env={**os.environ, "MONO_ENV_OPTIONS": options})
    assert (result.returncode, result.stderr.count("\n")) == (1, 1)
    assert "MONO_ENV_OPTIONS sets optimizations" in result.stderr


@pytest.mark.parametrize("name", ["MPLBACKEND", "PYTHONHOME", "PYTHONWARNINGS", "SOURCE_DATE_EPOCH"])
def test_sweeps_and_figures_ignore_settings_of_the_user_s_python(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(name, "module://matplotlib_inline.backend_inline")
    assert name not in experiments.environment()


def test_files_are_utf_8_in_any_locale(checkout: Checkout) -> None:
    (checkout.root / "scripts/collektive.py").write_text("import sys; print(sys.flags.utf8_mode)")
    result = subprocess.run([checkout.root / "collektive"], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    assert result.stdout == "1\n", result.stderr
