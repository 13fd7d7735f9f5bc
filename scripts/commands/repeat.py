"""Repeats a run from its manifest.json, and compares its results: ticks, digest, metrics and convergence times. Scripts, schema and programs are read
from their original paths, or from --folder. Prints a line for each of them, and for the JVM, if it has changed.

Exit code: 0 the results are equal; 1 they differ, the run could not be repeated, or rounds failed."""
import argparse
import os
from pathlib import Path

from build.console import Failure
from commands.run import run_scenario


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("manifest", type=Path, metavar="MANIFEST.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: the manifest's folder with the suffix -repeated)")
    parser.add_argument("--overwrite", action="store_true", help="replace the results of an earlier run in that folder")
    parser.add_argument("--folder", metavar="DIR", help="folder of the scenario file, if the project was moved")
    parser.add_argument("--trust-jvm", action="store_true", help="see ./collektive run --help")


def run(arguments: argparse.Namespace) -> int:
    manifest: Path = arguments.manifest
    if not manifest.is_file():
        raise Failure(f"repeat: '{manifest}' {'is not a file: name the manifest.json of a run' if manifest.exists() else 'does not exist'}")
    if b'"folder":' not in manifest.read_bytes():
        raise Failure(f"repeat: '{manifest}' is not the manifest of a run; to run a scenario file, use ./collektive run")
    out = arguments.out or f"{manifest.parent.resolve()}-repeated"
    if os.path.realpath(out) == os.path.realpath(manifest.parent):
        raise Failure(f"repeat: --out '{out}' contains the run to repeat: name another folder")
    return run_scenario(str(manifest), out=out, overwrite=arguments.overwrite, folder=arguments.folder, trust_jvm=arguments.trust_jvm)
