"""Tests the outputs of `site` and `package`, for example on a full disk."""
import errno
import functools
import os
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from build import package
from build.console import Failure
from commands import site

FULL = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_site_that_cannot_be_copied_keeps_the_earlier_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    new, out = tmp_path / "new", tmp_path / "out/site"
    for folder, content in ((new, "new"), (out, "earlier")):
        folder.mkdir(parents=True)
        (folder / "index.html").write_text(content)
        (folder / site.MARKER).touch()

    def copy(_: str, target: str, **__: Any) -> None:
        Path(target).write_text("half")
        raise FULL

    with monkeypatch.context() as patch:
        patch.setattr(shutil, "copytree", functools.partial(shutil.copytree, copy_function=copy))
        with pytest.raises(Failure, match=r"site: cannot write '.*/out/site': .*No space left on device"):
            site.replace(new, out)
    assert ((out / "index.html").read_text(), os.listdir(out.parent)) == ("earlier", ["site"])
    site.replace(new, out)
    assert ((out / "index.html").read_text(), os.listdir(out.parent)) == ("new", ["site"])


def test_a_folder_that_appears_during_the_build_is_not_replaced(tmp_path: Path) -> None:
    for name in ("new", "out"):
        (tmp_path / name).mkdir()
    (tmp_path / "out/thesis.txt").touch()
    with pytest.raises(Failure, match="exists and is not a site"):
        site.replace(tmp_path / "new", tmp_path / "out")
    assert os.listdir(tmp_path / "out") == ["thesis.txt"]


def test_an_archive_that_cannot_be_moved_keeps_the_earlier_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "a.tgz").write_text("earlier")

    def pack(*_: object, **__: object) -> SimpleNamespace:
        (tmp_path / "archive/a.tgz").write_text("new")
        return SimpleNamespace(returncode=0, stdout="a.tgz\n")

    def move(_: Path, target: Path) -> None:
        target.write_text("half")
        raise FULL

    monkeypatch.setattr(subprocess, "run", pack)
    with monkeypatch.context() as patch:
        patch.setattr(shutil, "move", move)
        with pytest.raises(OSError, match="No space left"):
            package._pack(tmp_path / "content", out, "")
    assert ((out / "a.tgz").read_text(), os.listdir(out)) == ("earlier", ["a.tgz"])
    package._pack(tmp_path / "content", out, "")
    assert ((out / "a.tgz").read_text(), os.listdir(out)) == ("new", ["a.tgz"])
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: SimpleNamespace(returncode=1, stdout=""))
    with pytest.raises(Failure, match="package: npm pack failed with code 1"):
        package._pack(tmp_path / "content", out, "")


def test_outputs_in_the_folders_of_samples_are_not_packed(tmp_path: Path) -> None:
    for name in ("Crowd/Crowd.cs", "Crowd/out/scenario-seed1/manifest.json", "Crowd/Generated/crowd/SensorData.cs"):
        (tmp_path / "Samples~" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "Samples~" / name).touch()
    package._copy(tmp_path / "Samples~", tmp_path / "content")
    assert [path.name for path in (tmp_path / "content").rglob("*")] == ["Crowd", "Crowd.cs"]


def test_an_archive_does_not_depend_on_the_umask(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    content = tmp_path / "content"
    (content / "folder").mkdir(parents=True, mode=0o700)
    for name, mode in (("tool", 0o700), ("text", 0o600)):
        (content / "folder" / name).touch(mode)

    def pack(*_: object, **__: object) -> SimpleNamespace:
        (tmp_path / "archive/a.tgz").touch()
        return SimpleNamespace(returncode=0, stdout="a.tgz\n")

    monkeypatch.setattr(subprocess, "run", pack)
    package._pack(content, tmp_path / "out", "")
    assert {path.name: path.stat().st_mode & 0o777 for path in content.rglob("*")} == {"folder": 0o755, "tool": 0o755, "text": 0o644}
