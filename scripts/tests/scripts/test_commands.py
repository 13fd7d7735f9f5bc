"""Tests how commands report steps that fail or are interrupted."""
import argparse
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from checkout import Checkout

import collektive
from build import graph, lock, maven, processes, projects
from build.console import Failure
from commands import bench, check, clean, demo, profile, repeat, setup
from commands import run as run_command


def write_experiment(folder: Path) -> Path:
    file = folder / "experiment.json"
    file.write_text('{"version": 1, "scenario": "scenario.json"}')
    return file


def test_scenarios_are_checked_while_the_outputs_are_locked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order: list[str] = []

    def record(kind: str) -> Callable[..., bool]:
        def check_file(*_: object) -> bool:
            order.append(kind)
            return True
        return check_file

    monkeypatch.setattr(graph, "build", lambda *_: None)
    monkeypatch.setattr(check, "_check_experiment", record("experiment"))
    monkeypatch.setattr(check, "_check_scenario", record("scenario"))
    assert check.run(argparse.Namespace(paths=[write_experiment(tmp_path), tmp_path / "scenario.json"], trust_jvm=False)) == 0
    # The check of an experiment releases the lock.
    assert order == ["scenario", "experiment"]


@pytest.mark.parametrize(("text", "kind"), [
    ('{"fields": {"scenario": 1, "a": {"scenario": 2}}, scene: "standard"}', check.SCENARIO),
    ('{"set": {"fields": {"scene": 1}}, "scenario": "a.json"}', check.EXPERIMENT),
    ('{"scene": "standard", "fields": {"scenario": "{"}}', check.SCENARIO),
    ('{"set": {"a": "}", "b": "{", "c": "{"}, "scenario": "a.json"}', check.EXPERIMENT),
    ('/* a {\n*/ { // "scenario": b\n"data": "http://c", "scene": "standard"}', check.SCENARIO)])
def test_nested_keys_and_comments_do_not_determine_the_kind_of_a_file(tmp_path: Path, text: str, kind: str) -> None:
    (tmp_path / "file.json").write_text(text)
    assert check.find_files(tmp_path) == [(tmp_path / "file.json", kind)]


def test_other_files_of_a_folder_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "misspelled.json").write_text('{"scenes": "standard"}')
    (tmp_path / "valid.json").write_text('{"scene": "standard"}')
    assert check.find_files(tmp_path) == [(tmp_path / "valid.json", check.SCENARIO)]
    assert capsys.readouterr().err == f"{tmp_path / 'misspelled.json'}: skipped, because it has neither the key 'scene' nor 'scenario'\n"


def test_unreadable_files_of_a_folder_are_checked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "unreadable.json").write_text('{"scene": "standard"}')

    def read(*_: object, **__: object) -> str:
        raise PermissionError

    monkeypatch.setattr(Path, "read_text", read)
    assert check.find_files(tmp_path) == [(tmp_path / "unreadable.json", check.SCENARIO)]


def test_pipes_are_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pipe = tmp_path / "pipe.json"
    os.mkfifo(pipe)
    # Reading would wait until another process writes to the pipe.
    monkeypatch.setattr(Path, "read_text", lambda *_, **__: pytest.fail("the pipe was read"))
    assert check.find_files(pipe) == [(pipe, check.SCENARIO)]


def test_ctrl_c_ends_a_check(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graph, "build", lambda *_: None)
    monkeypatch.setattr(lock, "release", lambda: None)
    monkeypatch.setattr(processes, "call", lambda *_: 130)
    with pytest.raises(KeyboardInterrupt):
        check.run(argparse.Namespace(paths=[write_experiment(tmp_path)], trust_jvm=False))


def test_a_failed_report_is_the_exit_code_of_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def run_scenario(recording: str, **_: object) -> int:
        Path(recording).write_text("")
        return 0

    monkeypatch.setattr(run_command, "run_scenario", run_scenario)
    monkeypatch.setattr(profile, "find_jdk", lambda: tmp_path)
    monkeypatch.setattr(processes, "call", lambda *_, **__: 3)
    assert profile.run(argparse.Namespace(scenario="", out=str(tmp_path), overwrite=False)) == 3


@pytest.mark.parametrize(("manifest", "is_replaced"), [
    ({"file": demo.SCENARIO.name, "folder": str(demo.SCENARIO.parent)}, True), ({"file": "demo.json", "folder": str(demo.SCENARIO.parent)}, False),
    ({"file": "demo.json", "folder": "/home/me", "scenario": {"scripts": str(demo.SCENARIO.parent)}}, False), ([], False)])
def test_a_demo_does_not_replace_the_run_of_another_scenario(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, manifest: object, is_replaced: bool) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(demo, "run_scenario", lambda _, overwrite, **__: overwrite)
    Path("out/demo-seed1").mkdir(parents=True)
    Path("out/demo-seed1/manifest.json").write_text(json.dumps(manifest))
    assert demo.run(argparse.Namespace(nodes=None, seconds=None, seed="1", out=None, overwrite=False)) == is_replaced


def test_errors_of_copies_are_reported_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("one", "other"):
        (tmp_path / "from").mkdir(exist_ok=True)
        (tmp_path / "from" / name).symlink_to("nowhere")
        (tmp_path / "to" / name).mkdir(parents=True)

    def copy(_: argparse.Namespace) -> int:
        shutil.copytree(tmp_path / "from", tmp_path / "to", dirs_exist_ok=True)
        return 0

    def move(_: argparse.Namespace) -> int:
        shutil.move(tmp_path / "from/one", tmp_path / "to")
        return 0

    for run, message in ((copy, "cannot write '{to}/o[a-z]+': .*No such file or directory.*"), (move, "Destination path '{to}/one' already exists")):
        assert collektive.run_command(argparse.Namespace(run=run)) == 1
        assert re.fullmatch(f"collektive: {message}\n".replace("{to}", re.escape(str(tmp_path / "to"))), capsys.readouterr().err)


def test_ctrl_c_during_the_start_prints_nothing() -> None:
    code = """
import os, runpy, sys
class Finder:
    def find_spec(name, path, target=None):
        if name == "resource":
            os.kill(os.getpid(), 2)
sys.meta_path.insert(0, Finder)
runpy.run_path(sys.argv[1], run_name="__main__")
"""
    ended = subprocess.run([sys.executable, "-I", "-c", code, collektive.__file__], capture_output=True)
    assert (ended.returncode, ended.stdout + ended.stderr) == (-signal.SIGINT, b"")


def test_setup_rejects_unknown_tools() -> None:
    with pytest.raises(Failure, match="setup: unknown tool 'flat'; known: flatbuffers, "):
        setup.run(argparse.Namespace(tools=["npm", "flat"]))


def test_clean_does_not_follow_links(checkout: Checkout, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (checkout.root / "build").symlink_to(tmp_path / "elsewhere")
    command = checkout.start_command("clean")
    errors = command.communicate()[1]
    assert (command.returncode, errors) == (1, f"collektive: '{checkout.root}/build' is a symbolic link: delete it and its target\n")


def test_a_build_after_an_interrupted_clean_starts_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "cmake").mkdir()
    (tmp_path / "a/target").mkdir(parents=True)
    for mark in (tmp_path / "cmake" / graph.STAMP.name, tmp_path / "cmake/.ninja_log", tmp_path / "a/target/main.key"):
        mark.touch()
    monkeypatch.setattr(clean, "BUILD", tmp_path)
    monkeypatch.setattr(clean, "JVM", tmp_path)
    monkeypatch.setattr(clean, "GRAPH", tmp_path / "cmake")
    monkeypatch.setattr(maven, "STARTED", tmp_path / "maven-started")
    monkeypatch.setattr(lock, "exclusive", lambda: None)
    (tmp_path / "stamp").mkdir()
    deleted: list[Path] = []

    def delete(folder: Path, **_: object) -> None:
        deleted.append(folder)
        if folder.name != "stamp":
            raise KeyboardInterrupt

    monkeypatch.setattr(shutil, "rmtree", delete)
    with pytest.raises(KeyboardInterrupt):
        clean.run(argparse.Namespace())
    assert deleted == [tmp_path / "stamp", tmp_path / "a/target"]
    assert (tmp_path / "maven-started").exists() and not os.listdir(tmp_path / "cmake")


def test_clean_succeeds_if_a_starting_command_writes_its_modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build = tmp_path / "build"
    (build / "pycache").mkdir(parents=True)
    monkeypatch.setattr(clean, "BUILD", build)
    monkeypatch.setattr(clean, "JVM", tmp_path / "jvm-host")
    monkeypatch.setattr(clean, "GRAPH", build / "cmake")
    monkeypatch.setattr(maven, "STARTED", build / "maven-started")
    monkeypatch.setattr(lock, "exclusive", lambda: None)
    remove = os.rmdir

    def rmdir(path: str | Path, **options: int) -> None:
        remove(path, **options)
        (build / "pycache").mkdir()

    with monkeypatch.context() as patch:
        patch.setattr(os, "rmdir", rmdir)
        assert clean.run(argparse.Namespace()) == 0
    assert os.listdir(build) == ["pycache"]


def test_a_cached_folder_without_its_output_is_built_again(tmp_path: Path) -> None:
    (tmp_path / "key").mkdir()
    (tmp_path / "key/rest").touch()
    jar = projects._cached(tmp_path / "key", "programs.jar", "test", [], lambda work, _: (work / "programs.jar").touch())
    assert jar.exists() and not (tmp_path / "key/rest").exists()


def test_simultaneous_compilations_have_separate_folders_also_with_equal_process_ids(tmp_path: Path) -> None:
    def compile_first(work: Path, _: object) -> None:
        (work / "programs.jar").write_text("first")

    def compile_slowly(work: Path, _: object) -> None:
        (work / "half").touch()
        projects._cached(tmp_path / "key", "programs.jar", "test", [], compile_first)
        assert (work / "half").exists()
        (work / "programs.jar").touch()

    (tmp_path / "killed.1").mkdir()
    jar = projects._cached(tmp_path / "key", "programs.jar", "test", [], compile_slowly)
    assert jar.read_text() == "first" and os.listdir(tmp_path) == ["key"]


def test_a_repetition_does_not_replace_its_original(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(repeat, "run_scenario", lambda *_, **__: 0)
    (tmp_path / "manifest.json").write_text('{"folder": ""}')
    (tmp_path / "link").symlink_to(tmp_path)
    arguments = argparse.Namespace(manifest=tmp_path / "manifest.json", out=str(tmp_path / "link"), overwrite=True, folder=None, trust_jvm=False)
    with pytest.raises(Failure, match="link' contains the run to repeat: name another folder"):
        repeat.run(arguments)


def test_names_of_files_may_begin_like_options(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run_command, "run", lambda arguments: 0 if arguments.scenario == "-a.json" else 1)
    assert run_command.run_scenario("-a.json") == 0
    parser = collektive.parser_for("sweep")
    monkeypatch.setattr(processes, "call", lambda command: 0 if parser.parse_args(list(map(str, command[1:]))).experiment == "-a.json" else 1)
    assert check._check_experiment(Path("-a.json"), ["--trust-jvm"])


def test_benchmarks_replace_only_their_results(tmp_path: Path) -> None:
    file = tmp_path / "notes.json"
    for content, expected in (('{"mine": 1}', pytest.raises(Failure, match="was not written by --out")), ('{\n  "machine": {}\n}\n', contextlib.nullcontext())):
        file.write_text(content)
        with expected:
            assert bench.run(argparse.Namespace(out=file, measure=lambda arguments: arguments.out.write_text("new") and 0)) == 0
    assert (file.read_text(), os.listdir(tmp_path)) == ("new", ["notes.json"])


@pytest.mark.parametrize("error", [OSError("full"), None], ids=["full disk", "failed measurement"])
def test_failed_benchmarks_keep_earlier_results(tmp_path: Path, error: OSError | None) -> None:
    def measure(arguments: argparse.Namespace) -> int:
        arguments.out.write_text("a part")
        if error:
            raise error
        return 1

    file = tmp_path / "earlier.json"
    file.write_text('{\n  "machine": {}\n}\n')
    with pytest.raises(OSError, match="full") if error else contextlib.nullcontext():
        assert bench.run(argparse.Namespace(out=file, measure=measure)) == 1
    assert (file.read_text(), os.listdir(tmp_path)) == ('{\n  "machine": {}\n}\n', ["earlier.json"])
