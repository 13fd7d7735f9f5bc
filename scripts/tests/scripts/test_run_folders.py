"""Tests that a run replaces earlier results only if it has begun."""
import json
import os
from pathlib import Path

import pytest

from build import outputs
from build.console import Failure

MANIFEST = '{"outcome": "complete"}'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "manifest.json").write_text(MANIFEST)
    (tmp_path / "profile.jfr").write_text("earlier")
    (tmp_path / "notes.txt").write_text("of the user")
    return tmp_path


def contents(folder: Path) -> dict[str, str]:
    return {file.name: file.read_text() for file in folder.iterdir()}


def test_existing_results_are_rejected_without_overwrite(folder: Path) -> None:
    with pytest.raises(Failure, match=r"has results of a run: manifest\.json, profile\.jfr; name another folder"), outputs.open_folder(folder, False):
        pass
    assert len(contents(folder)) == 3


def test_files_with_names_of_unfinished_results_are_kept_without_a_manifest(tmp_path: Path) -> None:
    (tmp_path / "metrics.csv.part").write_text("download")
    with pytest.raises(Failure, match=r"has metrics\.csv\.part, but no manifest of a run"), outputs.open_folder(tmp_path, True):
        pass
    assert contents(tmp_path) == {"metrics.csv.part": "download"}


def test_the_folder_of_a_sweep_is_rejected(tmp_path: Path) -> None:
    (tmp_path / ".collektive-sweep").touch()
    with pytest.raises(Failure, match=r"is the folder of a sweep: name another folder"), outputs.open_folder(tmp_path, True):
        pass
    assert contents(tmp_path) == {".collektive-sweep": ""}


@pytest.mark.parametrize("place", ["runs/seed=1", "runs/seed=2.part", "bundle"])
def test_folders_that_a_sweep_may_delete_are_rejected(place: str, tmp_path: Path) -> None:
    folder = tmp_path / place
    folder.mkdir(parents=True)
    for marked in (tmp_path, folder):
        (marked / ".collektive-sweep").touch()
    with pytest.raises(Failure, match=r"belongs to a sweep, which may delete it: name another folder"), outputs.open_folder(folder / "a/b", True):
        pass
    assert not (folder / "a").exists()
    with outputs.open_folder(tmp_path / "runs/seed=1-repeated", False):
        pass


def test_a_run_that_starts_replaces_the_results(folder: Path) -> None:
    with outputs.open_folder(folder, True):
        (folder / "manifest.json").write_text("running")
    assert contents(folder) == {"manifest.json": "running", "notes.txt": "of the user"}


def test_results_are_restored_if_the_run_does_not_start(folder: Path) -> None:
    before = contents(folder)
    with outputs.open_folder(folder, True):
        assert not (folder / "manifest.json").exists()
        (folder / "run.clkrec.part").touch()
    assert contents(folder) == before


def test_results_are_restored_if_the_run_completes_no_tick(folder: Path) -> None:
    before = contents(folder)
    with outputs.open_folder(folder, True):
        (folder / "metrics.csv").write_text("second")
        (folder / "manifest.json").write_text('{"outcome": "failed: the JVM rejects its options", "ticks": 0}')
    assert contents(folder) == before


@pytest.mark.parametrize("outcome", [outputs.COMPLETE, outputs.WITHOUT_PICTURES])
def test_results_are_replaced_if_a_script_ends_the_run_before_its_first_tick(folder: Path, outcome: str) -> None:
    manifest = json.dumps({"outcome": outcome, "ticks": 0})
    with outputs.open_folder(folder, True):
        (folder / "manifest.json").write_text(manifest)
    assert contents(folder) == {"manifest.json": manifest, "notes.txt": "of the user"}


def test_results_are_restored_by_the_command_after_a_killed_one(folder: Path) -> None:
    before = contents(folder)
    earlier = folder / outputs.BACKUP
    earlier.mkdir()
    (folder / "manifest.json").rename(earlier / "manifest.json")
    with pytest.raises(Failure, match="has results of a run"), outputs.open_folder(folder, False):
        pass
    assert contents(folder) == before


def test_a_pipe_is_not_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "manifest.json").unlink()
    os.mkfifo(folder / "manifest.json")
    # Reading would wait until another process writes to the pipe.
    monkeypatch.setattr(Path, "read_bytes", lambda *_: pytest.fail("the pipe was read"))
    with pytest.raises(Failure, match="but no manifest of a run"), outputs.open_folder(folder, True):
        pass


def test_files_not_written_by_a_run_are_kept(folder: Path) -> None:
    (folder / "manifest.json").write_text('{"name": "a page of the user"}')
    before = contents(folder)
    with pytest.raises(Failure, match="but no manifest of a run"), outputs.open_folder(folder, True):
        pass
    assert contents(folder) == before


def test_a_folder_of_the_user_is_not_emptied(folder: Path) -> None:
    (folder / outputs.BACKUP).mkdir()
    thesis = folder / outputs.BACKUP / "thesis.txt"
    thesis.write_text("all of it")
    with pytest.raises(Failure, match="cannot write to the output folder"), outputs.open_folder(folder, True):
        pass
    assert thesis.read_text() == "all of it"


def test_a_link_to_a_folder_of_the_user_is_not_followed(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "metrics.csv").write_text("of the user")
    (folder / outputs.BACKUP).symlink_to(elsewhere)
    with pytest.raises(Failure, match="cannot write to the output folder"), outputs.open_folder(folder, True):
        pass
    assert (elsewhere / "metrics.csv").read_text() == "of the user"


@pytest.mark.parametrize("manifest", [None, '{"outcome": "running"}', '{"outcome": "failed: Disk full"}'])
def test_a_printed_file_error_is_the_only_message(folder: Path, manifest: str | None) -> None:
    (folder / "manifest.json").unlink()
    if manifest is not None:
        (folder / "manifest.json").write_text(manifest)
    with pytest.raises(Failure) as failure:
        outputs.require(folder, outputs.COMPLETE, outputs.FILE_ERROR)
    assert (str(failure.value), failure.value.code) == ("", 1)


def test_pipes_and_folders_are_not_replaced(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for file in (tmp_path / "pipe", tmp_path):
        with pytest.raises(Failure, match="is not a regular file: name another file"):
            outputs.require_replaceable(str(file), b"CLKREC", "--out")


@pytest.mark.parametrize(("manifest", "words"), [(None, "wrote no usable manifest"), ("", "wrote no usable manifest"), ("{}", "wrote no usable manifest"),
                                                 ('{"outcome": "running"}', "the player exited with code 0 during the run"),
                                                 ('{"outcome": "failed: no luck"}', "the run is not complete: failed: no luck"),
                                                 ('{"outcome": "the pictures are missing"}', "the run is not complete: the pictures are missing")])
def test_exit_code_0_needs_a_complete_manifest(tmp_path: Path, manifest: str | None, words: str) -> None:
    if manifest is not None:
        (tmp_path / "manifest.json").write_text(manifest)
    with pytest.raises(Failure, match=words):
        outputs.require(tmp_path, outputs.COMPLETE, 0)


def test_a_folder_that_was_replaced_during_the_run_is_an_error(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with pytest.raises(Failure, match="was moved, deleted or replaced during the run"), outputs.open_folder(out, False):
        out.rename(tmp_path / "moved")
        out.mkdir()
        (out / "manifest.json").write_text("of another run")
    assert contents(out) == {"manifest.json": "of another run"}


def test_a_script_may_return_the_code_of_a_file_error(folder: Path) -> None:
    outputs.require(folder, outputs.COMPLETE, outputs.FILE_ERROR)
