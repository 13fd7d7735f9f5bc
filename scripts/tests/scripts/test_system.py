"""Tests the reports about missing and outdated tools, with fake tools on the PATH."""
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest

from build import fetch, jdk, system
from build.console import Failure
from build.places import ROOT


class Tools:
    """A folder of fake tools that is on the PATH before the real tools."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def path(self, name: str) -> str:
        return str(self.folder / name)

    def fake(self, name: str, text: str) -> None:
        """Adds a fake command as a shell script, and hides the alternative command of the same tool."""
        (self.folder / name).write_text(f"#!/bin/sh\n{text or 'exit 1'}\n")
        (self.folder / name).chmod(0o755)
        if name == "cargo":
            self.fake("cargo-1.85", "")

    def missing(self, tool: str, version: str, packages: Sequence[tuple[str, str]] = ()) -> str:
        """Returns the report about a tool that prints the given version, or nothing if it is empty. apt offers the given packages and versions."""
        self.fake("apt-cache", "".join(f"[ $2 != {name} ] || echo '  Candidate: {version}'\n" for name, version in packages))
        self.fake(tool, version and f"echo '{version}'")
        return self.report()

    @staticmethod
    def report() -> str:
        """Returns the reason why the system cannot be used, or an empty string."""
        try:
            system.setup_system()
        except Failure as failure:
            return str(failure)
        return ""


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Tools:
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    monkeypatch.setattr(system, "BUILD", tmp_path / "build")
    monkeypatch.setattr(system, "can_install", lambda: False)
    return Tools(tmp_path)


def test_an_outdated_tool_is_reported_with_its_version_and_package(tools: Tools) -> None:
    report = tools.missing("cargo", "cargo 1.65.0", [("cargo", "0.66.0+ds1-1"), ("cargo-web", "1.85.0+dfsg3-1~deb12u3")])
    assert f"{tools.path('cargo')} has version 1.65.0; 1.85 or newer is needed" in report
    assert report.endswith("apt-get install cargo-web")


@pytest.mark.parametrize("packages, expected", [
    ([("cargo", "1.85.1+dfsg1-1+deb13u1"), ("cargo-web", "1.96.0")], "cargo"),
    ([("cargo", "1.75.0"), ("cargo-1.85", "1.85.1+dfsg0")], "cargo-1.85"),
    ([], "cargo"),
])
def test_the_suggested_package_is_new_enough(tools: Tools, packages: list[tuple[str, str]], expected: str) -> None:
    assert tools.missing("cargo", "cargo 1.75.0", packages).endswith(f"apt-get install {expected}")


def test_options_that_the_jvm_rejects_are_not_taken_for_an_outdated_tool(tools: Tools, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JAVA_TOOL_OPTIONS", "-XX:+NoSuchOption")
    assert tools.report() == ""
    jdk.find_jdk.cache_clear()
    with pytest.raises(Failure, match=r"the JVM does not start with JAVA_TOOL_OPTIONS=-XX:\+NoSuchOption: .*NoSuchOption"):
        jdk.find_jdk()


def test_modules_in_the_current_folder_are_not_executed(tools: Tools, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("build.console.LOGS", tools.folder / "log")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    for module in ("collections", "ensurepip", "os", "venv"):
        (tools.folder / f"{module}.py").write_text(f"open({tools.path('executed')!r}, 'w')")
    (tools.folder / "requirements.txt").touch()
    monkeypatch.chdir(tools.folder)
    assert tools.report() == ""
    fetch._environment(tools.folder / "requirements.txt", tools.folder / "environment")
    assert not (tools.folder / "executed").exists()


def test_on_a_fresh_system_the_package_is_chosen_when_apt_has_its_lists(tools: Tools, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system, "can_install", lambda: True)
    monkeypatch.setattr("build.console.LOGS", tools.folder / "log")
    lists, installed = tools.path("lists"), tools.path("installed")
    tools.fake("cargo", "echo cargo 1.75.0")
    tools.fake("apt-cache", f"""[ -e {lists} ] || exit 0
        case $2 in cargo) echo '  Candidate: 1.75.0' ;; cargo-1.85) echo '  Candidate: 1.85.1' ;; esac""")
    tools.fake("apt-get", f"""case $1 in
        update) touch {lists} ;;
        install) echo "$*" >{installed}; printf '#!/bin/sh\necho cargo 1.85.1\n' >{tools.path("cargo-1.85")} ;;
        esac""")
    assert tools.report() == ""
    assert Path(installed).read_text().rstrip().endswith(" cargo-1.85")


@pytest.mark.parametrize("tool, version", [
    ("mvn", "\033[1mApache Maven 3.8.7\033[m"), ("javac", "javac 25"), ("node", "v18.20.4"), ("cargo", "cargo 1.100.0 (abc 2027-01-01)"),
    ("cc", "cc (Ubuntu 13.2.0-23ubuntu4) 13.2.0"),
])
def test_all_version_formats_are_parsed(tools: Tools, tool: str, version: str) -> None:
    assert tools.missing(tool, version) == ""


def test_a_tool_without_a_version_is_not_used(tools: Tools) -> None:
    assert f"{tools.path('npm')} --version fails; 8 or newer is needed" in tools.missing("npm", "")


def test_a_tool_that_explains_why_it_fails_is_quoted(tools: Tools) -> None:
    message = "error: rustup could not choose a version of cargo to run, because one wasn't specified explicitly, and no default is configured."
    tools.fake("cargo", f'echo "{message}" >&2\necho "help: run rustup default stable" >&2\nexit 1')
    report = tools.report()
    assert f"{tools.path('cargo')} --version fails: {message}; 1.85 or newer is needed" in report
    assert "unknown" not in report


def test_a_missing_tool_is_reported(tools: Tools, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tools.folder))
    tools.fake("python3", "echo Python 3.11.4")
    assert "ninja is missing; 1.11 or newer is needed" in tools.report()


def test_a_tool_that_is_replaced_is_checked_again(tools: Tools) -> None:
    assert tools.missing("node", "v18.0.0") == ""
    assert tools.missing("node", "v16.20.10") != ""


def test_a_cargo_that_cannot_reach_its_registry_is_a_one_line_error(tools: Tools, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr("build.console.LOGS", tools.folder / "log")
    tools.fake("cargo", 'case $1 in --version) echo cargo 1.85.0 ;; *) echo "error: failed to download from the registry" >&2; exit 101 ;; esac')
    with pytest.raises(Failure, match=r"^flatbuffers failed; the full log is .*flatbuffers\.log$"):
        fetch.FETCHERS["flatbuffers"][1](tools.folder / "flatbuffers")
    shown = capsys.readouterr().err
    assert "failed to download from the registry" in shown
    assert "Traceback" not in shown


def test_an_older_python_is_rejected(tmp_path: Path) -> None:
    old = "import runpy, sys; sys.version_info = (3, 9, 2, 'final', 0); sys.version = '3.9.2 (default)'; runpy.run_path(sys.argv[1], run_name='__main__')"
    result = subprocess.run(["python3", "-I", "-c", old, ROOT / "scripts/collektive.py", "--help"], capture_output=True, text=True)
    assert result.returncode == 1
    assert "collektive: Python 3.11 or newer is needed, and " in result.stderr and result.stderr.rstrip().endswith("has version 3.9.2")
    assert len(result.stderr.splitlines()) == 1


def test_python_imports_nothing_from_the_current_folder(tools: Tools, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for module in ("ensurepip", "collections", "venv"):
        Path(f"{module}.py").write_text("open('executed', 'w')")
    monkeypatch.setattr(fetch, "_install", lambda *_: None)
    monkeypatch.setattr("build.console.LOGS", tmp_path / "log")
    system.find_missing()
    fetch._environment(tmp_path, tmp_path / "environment")
    assert not Path("executed").exists()
