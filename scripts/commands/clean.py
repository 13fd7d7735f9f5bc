"""Removes build/ and the target/ folders of the JVM modules. Keeps results in out/."""
import argparse
import shutil

from build import lock
from build.console import Failure
from build.places import BUILD, JVM


def add_arguments(parser: argparse.ArgumentParser) -> None:
    pass


def run(_: argparse.Namespace) -> int:
    lock.exclusive()
    for folder in [BUILD, JVM / "target", *JVM.glob("*/target")]:
        if folder.is_symlink():
            raise Failure(f"'{folder}' is a symbolic link: delete it and its target")
        if folder.exists():
            shutil.rmtree(folder)
    return 0
