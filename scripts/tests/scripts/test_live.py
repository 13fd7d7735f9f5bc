"""Tests the records and the sources of live runs."""
import argparse
import asyncio
import importlib
import json
import os
import shutil
import struct
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast
from unittest.mock import AsyncMock, MagicMock

import pytest

from build import inputs, sample_programs
from build.console import Failure
from commands import live
from live import examples, session
from live.record import Record


def chunk(kind: bytes, payload: bytes = b"payload") -> bytes:
    return struct.pack("<4sII", kind, len(payload), 0) + payload


HEAD = b"CLKREC\1\0" + chunk(b"HEAD") + chunk(b"OPEN") + chunk(b"JAR ")
TICK = chunk(b"STEP") + chunk(b"DONE")


def test_a_saved_record_ends_with_the_last_finished_tick(tmp_path: Path) -> None:
    source = tmp_path / "run.clkrec"
    source.write_bytes(HEAD + TICK + TICK + chunk(b"STEP") + chunk(b"DONE")[:-1])
    Record(source).save(tmp_path / "saved.clkrec")
    # The last four bytes are the CRC-32 of an empty END chunk.
    assert (tmp_path / "saved.clkrec").read_bytes() == HEAD + TICK + TICK + b"END \0\0\0\0" + bytes.fromhex("ba7a6345")


@pytest.mark.parametrize("content", [None, b"", HEAD, HEAD + chunk(b"STEP")])
def test_a_run_without_a_finished_tick_has_no_record(content: bytes | None, tmp_path: Path) -> None:
    source = tmp_path / "run.clkrec"
    if content is not None:
        source.write_bytes(content)
    with pytest.raises(Failure, match="the run has not finished a tick yet"):
        Record(source).save(tmp_path / "saved.clkrec")
    assert not (tmp_path / "saved.clkrec").exists()


def test_a_saved_record_replaces_no_file(tmp_path: Path) -> None:
    source = tmp_path / "run.clkrec"
    source.write_bytes(HEAD + TICK)
    (tmp_path / "link.clkrec").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(FileExistsError):
        Record(source).save(tmp_path / "link.clkrec")
    assert not (tmp_path / "elsewhere").exists()


def test_a_file_that_cannot_be_written_completely_is_removed(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="the disk is full"), session.new_file(tmp_path / "new.json") as output:
        output.write(b"half")
        raise OSError("the disk is full")
    assert not (tmp_path / "new.json").exists()


def test_a_large_record_is_deleted_while_the_player_writes_it(tmp_path: Path) -> None:
    source = tmp_path / "run.clkrec"
    record = Record(source, maximum=100_000)
    assert not record.limit()
    with source.open("wb") as player:
        player.write(b"x" * 200_000)
        player.flush()
        assert record.limit()
        player.write(b"x" * 200_000)
        player.flush()
        assert not record.limit(), "the deletion must be reported only once"
        player.write(b"x")
        player.flush()
        assert source.stat().st_blocks * 512 < 100_000
    with pytest.raises(Failure, match=r"the record exceeded 0\.0001 GB and was deleted; press Restart"):
        record.save(tmp_path / "saved.clkrec")
    record.begin()
    assert not source.exists()
    source.write_bytes(HEAD + TICK)
    record.save(tmp_path / "saved.clkrec")


def test_a_record_that_is_deleted_while_it_is_saved_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = tmp_path / "run.clkrec"
    source.write_bytes(HEAD + 10_000 * TICK)
    record = Record(source, maximum=100_000)

    def copy(*_: object) -> None:
        assert record.limit()

    monkeypatch.setattr(shutil, "copyfileobj", copy)
    with pytest.raises(Failure, match="was deleted; press Restart"):
        record.save(tmp_path / "saved.clkrec")
    assert os.listdir(tmp_path) == ["run.clkrec"]


def sources(project: Path) -> dict[str, session.Source]:
    plan: Any = SimpleNamespace(parts={"programs": inputs.programs(project / "programs")})
    return session.sources(cast(Any, plan), project)


@pytest.mark.parametrize(("before", "shown", "after"), [
    (b"a\nb\n", "a\nb\n", b"x\ny\n"),
    (b"a\r\nb\r\n", "a\nb\n", b"x\r\ny\r\n"),
    (b"\xef\xbb\xbfa\r\nb\nc\r\n", "a\nb\nc\n", b"\xef\xbb\xbfx\r\ny\r\n"),
    (b"", "", b"x\ny\n"),
])
def test_saving_keeps_the_line_ends_and_the_mark(before: bytes, shown: str, after: bytes, tmp_path: Path) -> None:
    file = tmp_path / "programs/A.kt"
    file.parent.mkdir()
    file.write_bytes(before)
    file.chmod(0o640)
    source = sources(tmp_path)["A.kt"]
    assert (source.text, source.problem) == (shown, "")
    source.write("x\ny\n")
    assert file.read_bytes() == after
    assert file.stat().st_mode & 0o777 == 0o640
    assert os.listdir(file.parent) == ["A.kt"]


def test_saving_writes_to_the_target_of_a_link_in_the_project(tmp_path: Path) -> None:
    project = tmp_path / "project"
    (project / "programs").mkdir(parents=True)
    (project / "A.kt").write_text("a")
    (tmp_path / "B.kt").write_text("b")
    (project / "programs/A.kt").symlink_to(project / "A.kt")
    (project / "programs/B.kt").symlink_to(tmp_path / "B.kt")
    found = sources(project)
    found["A.kt"].write("x")
    assert (project / "A.kt").read_text() == "x"
    assert (project / "programs/A.kt").is_symlink()
    assert found["B.kt"].problem == f"the file is a link to '{tmp_path / 'B.kt'}', which is not in the project's folder"


def test_a_source_that_is_not_utf_8_has_the_reason(tmp_path: Path) -> None:
    file = tmp_path / "programs/A.kt"
    file.parent.mkdir()
    file.write_bytes(b"\xef\xbb\xbf// caf\xe9")
    assert sources(tmp_path)["A.kt"].problem == "the file is not UTF-8 (byte 9): convert it in another editor"


def test_sources_that_vanish_before_their_compilation_are_reported(tmp_path: Path) -> None:
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "A.kt").write_text("a")
    plan: Any = SimpleNamespace(parts={"programs": inputs.programs(programs)})
    shutil.rmtree(programs)
    compiled = asyncio.run(session.Compiler(tmp_path).compile(plan))
    assert compiled.jar is None
    assert str(programs) in compiled.messages


def test_sources_that_return_unchanged_are_compiled_again(tmp_path: Path) -> None:
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "A.kt").write_text("a")
    plan: Any = SimpleNamespace(parts={"programs": inputs.programs(programs)})
    changes = session.Changes(lambda: session.sources(plan, tmp_path))
    known = sources(tmp_path)
    assert changes.since(known) is None
    programs.rename(tmp_path / "away")
    assert changes.since(known) is None
    (tmp_path / "away").rename(programs)
    assert changes.since(known) == known
    assert changes.since(known) is None


def test_a_set_option_without_a_value_is_refused() -> None:
    parser = argparse.ArgumentParser()
    live.add_arguments(parser)
    with pytest.raises(Failure, match="--set reading: write it as --set KEY=VALUE"):
        live.run(parser.parse_args(["gradient", "--set", "reading"]))


def test_an_interrupted_copy_of_an_example_is_not_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    scenario = examples.find("GradientAscent")
    assert scenario is not None
    with monkeypatch.context() as context:
        context.setattr(sample_programs, "folder", MagicMock(side_effect=KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            examples.copy(scenario)
    assert os.listdir("out/live") == []
    assert json.loads(examples.copy(scenario).read_text())["programs"] == "programs"
    assert list(Path("out/live/GradientAscent/programs").glob("**/*.kt"))


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Any:
    # The environment of this suite does not contain this package.
    for name in ("asyncio.server", "datastructures", "exceptions", "http11"):
        monkeypatch.setitem(sys.modules, f"websockets.{name}", MagicMock())
    return importlib.import_module("live.server")


@pytest.mark.parametrize(("error", "message"), [
    (PermissionError(13, "Permission denied", "A.kt"), "[Errno 13] Permission denied: 'A.kt'"),
    # A page can send a value with a null character, which a command line cannot contain.
    (ValueError("embedded null byte"), "embedded null byte"),
])
def test_an_error_at_a_restart_is_reported_to_the_page(error: Exception, message: str, tmp_path: Path, server: Any) -> None:
    live_run = server.Live({"scenario": "a.json", "trust_jvm": False, "seed": None, "values": []}, tmp_path)
    live_run.plan = None
    live_run.player = AsyncMock()
    live_run.start = AsyncMock(side_effect=error)
    asyncio.run(live_run.restart("b.json", None, {}, False))
    assert live_run.stopped == {"event": "stopped", "message": message}
    assert live_run.scenario == "a.json"


def test_a_saved_scenario_contains_the_texts_of_text_fields(tmp_path: Path, server: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    options = {"scenario": str(tmp_path / "a.json"), "trust_jvm": False, "seed": None, "values": ["label=5", "fields.note=6", "nodes=7"]}
    live_run = server.Live(options, tmp_path)
    live_run.header = {"sceneFields": {"label": "5", "note": "6", "nodes": 7, "range": "Infinity"}}
    live_run.plan = server.player.Plan({"file": {"fields": {"label": 5, "note": 8, "nodes": 7, "range": 9}}}, {})
    monkeypatch.setattr(server.player, "plan", lambda *_: live_run.plan)
    asyncio.run(live_run.save_scenario("b.json", {"fields.note": 8, "fields.range": 9}))
    assert json.loads((tmp_path / "b.json").read_text())["fields"] == {"label": "5", "note": "8", "nodes": 7, "range": 9}


def test_a_saved_scenario_contains_the_parameters_that_the_page_has_set(tmp_path: Path, server: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    live_run = server.Live({"scenario": str(tmp_path / "a.json"), "trust_jvm": False, "seed": None, "values": []}, tmp_path)
    live_run.pages = [page := MagicMock()]
    # Numbers in JSON would lose digits that text parameters keep.
    changed = {"gain": "1", "version": "1.0", "big": "1e3", "on": "false", "end": "NaN"}
    for name, value in changed.items():
        asyncio.run(live_run.execute(page, {"parameter": name, "program": "a.b", "value": value}))
    live_run.plan = server.player.Plan({"file": {"parameters": {"a.b": {"gain": 3, "other": 4}}}}, {})
    monkeypatch.setattr(server.player, "plan", lambda *_: live_run.plan)
    # The program declares no parameter `on`, because it was edited.
    known = {name: ["1", "Float"] for name in ("gain", "other", "version", "big", "end")}
    monkeypatch.setattr(server.projects, "parameters", lambda _: {"a.b": known})
    message = asyncio.run(live_run.save_scenario("b.json", {}))
    assert message.endswith("b.json without a.b.on, which the edited programs do not declare")
    del changed["on"]
    assert json.loads((tmp_path / "b.json").read_text())["parameters"] == {"a.b": {**changed, "other": 4}}
    live_run.player = MagicMock()
    asyncio.run(live_run.execute(page, {"parameter": "gain", "program": "a.b", "value": "fast"}))
    assert "'parameters.a.b.gain' is 'fast'; it must be a number" in page.event.call_args.args[0]["message"]
    assert (live_run.parameters["a.b", "gain"], live_run.player.send.call_count) == ("1", 0)


def test_a_page_that_begins_to_control_the_run_shows_the_current_parameters(tmp_path: Path, server: Any) -> None:
    live_run = server.Live({"scenario": str(tmp_path / "a.json"), "trust_jvm": False, "seed": "1", "values": []}, tmp_path)
    live_run.plan = SimpleNamespace(parts={"programs": SimpleNamespace(path=tmp_path)})
    live_run.header = {"event": "header", "parameters": {"a": {"gain": "1", "on": "true"}}}
    live_run.pages = [page := MagicMock()]
    asyncio.run(live_run.execute(page, {"parameter": "gain", "program": "a", "value": "2"}))
    live_run.send_welcome(page)
    assert page.event.call_args.args[0]["parameters"] == {"a": {"gain": "2", "on": "true"}}


def test_a_scenario_that_changed_during_the_run_is_not_saved_under_another_name(tmp_path: Path, server: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    live_run = server.Live({"scenario": str(tmp_path / "a.json"), "trust_jvm": False, "seed": None, "values": []}, tmp_path)
    live_run.plan = server.player.Plan({"file": {"deltaTime": 0.1}}, {}, content=b'{"deltaTime": 0.1}')
    monkeypatch.setattr(server.player, "plan", lambda *_: server.player.Plan({"file": {"deltaTime": 0.2}}, {}, content=b'{"deltaTime": 0.2}'))
    message = asyncio.run(live_run.save_scenario("b.json", {}))
    assert message == "not saved: 'a.json' changed since the start of the run; press Restart first"
    assert not (tmp_path / "b.json").exists()


def test_the_manifest_of_a_run_is_not_saved_as_a_scenario(tmp_path: Path, server: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    # The player ignores changes of a manifest, so they would be missing in the saved file.
    live_run = server.Live({"scenario": str(tmp_path / "manifest.json"), "trust_jvm": False, "seed": None, "values": []}, tmp_path)
    live_run.plan = server.player.Plan({"file": {"scenario": {"fields": {"nodes": 5}}, "folder": "/project"}}, {})
    monkeypatch.setattr(server.player, "plan", lambda *_: live_run.plan)
    message = asyncio.run(live_run.save_scenario("b.json", {"fields.nodes": 7}))
    assert message == "not saved: 'manifest.json' is the manifest of a run, which cannot be changed; open its scenario"
    assert not (tmp_path / "b.json").exists()


def test_a_program_that_changes_before_the_page_reads_it_does_not_run(tmp_path: Path, server: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    scenario, program = tmp_path / "a.json", tmp_path / "programs/A.kt"
    program.parent.mkdir()
    scenario.touch()
    program.touch()
    live_run = server.Live({"scenario": str(scenario), "trust_jvm": False, "seed": None, "values": []}, tmp_path)
    live_run.player = AsyncMock()
    plan = server.player.Plan({}, {"programs": inputs.programs(program.parent)}, scenario)
    program.write_text("new")
    monkeypatch.setattr(server.player, "plan", lambda *_: plan)
    with pytest.raises(Failure, match="changed during compilation"):
        asyncio.run(live_run.start())
    assert live_run.player.start.call_count == 0
