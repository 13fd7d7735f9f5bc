"""Removes build/ and the target/ folders of the JVM modules. Keeps results in out/."""
import argparse
import errno
import shutil
from pathlib import Path

from build import graph, lock, maven
from build.console import Failure
from build.places import BUILD, GRAPH, JVM


def add_arguments(parser: argparse.ArgumentParser) -> None:
    pass


def run(_: argparse.Namespace) -> int:
    lock.exclusive()
    folders = [JVM / "target", *JVM.glob("*/target"), BUILD]
    for folder in folders:
        if folder.is_symlink():
            raise Failure(f"'{folder}' is a symbolic link: delete it and its target")
    if BUILD.exists():
        # If this command is interrupted, the next build repeats each step whose outputs may be incomplete.
        maven.STARTED.touch()
        for mark in (graph.STAMP.name, ".ninja_log"):
            (GRAPH / mark).unlink(missing_ok=True)
    for folder in [BUILD / "stamp", *folders]:
        if folder.exists():
            shutil.rmtree(folder, onerror=_raise_unless_changed)
    return 0


def _raise_unless_changed(_: object, path: str, error: tuple[type[BaseException], BaseException, object]) -> None:
    """Raises an error of a deletion, unless another command has just written its compiled modules to build/pycache."""
    is_changed = isinstance(error[1], OSError) and error[1].errno in (errno.ENOENT, errno.ENOTEMPTY)
    if not is_changed or not (Path(path) == BUILD or Path(path).is_relative_to(BUILD / "pycache")):
        raise error[1]
