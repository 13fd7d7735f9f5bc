"""Removes build/ and the target/ folders of the JVM modules. Keeps results in out/."""
import argparse
import errno
import shutil

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
        for mark in (graph.STAMP, GRAPH / ".ninja_log"):
            mark.unlink(missing_ok=True)
    for folder in [BUILD / "stamp", *folders]:
        if folder.exists():
            shutil.rmtree(folder, onerror=_report)
    return 0


def _report(_: object, __: str, error: tuple[type[BaseException], BaseException, object]) -> None:
    """Raises an error of a deletion, unless another process has just changed the folder: commands that start write their modules to build/pycache."""
    if not isinstance(error[1], OSError) or error[1].errno not in (errno.ENOENT, errno.ENOTEMPTY):
        raise error[1]
