"""Repeats a run from its manifest.json alone, and compares ticks, digest and the metrics at the end. Scripts, schema and programs are found at
their original paths, or in --folder: the folder of the run's scenario file. One line names each of them, and the JVM, that has changed.

Exit code: 0 the results are equal; 1 they differ, the run could not be repeated, or rounds failed, as in the original."""
import argparse
from pathlib import Path

from build.console import Failure
from commands.run import run_scenario


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("manifest", type=Path, metavar="MANIFEST.json")
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: the manifest's folder with -repeated behind its name)")
    parser.add_argument("--overwrite", action="store_true", help="remove the results of an earlier run in that folder first")
    parser.add_argument("--folder", metavar="DIR", help="where the files of the project are now")
    parser.add_argument("--trust-jvm", action="store_true", help="as for ./collektive run")


def run(arguments: argparse.Namespace) -> int:
    manifest: Path = arguments.manifest
    if not manifest.is_file():
        raise Failure(f"repeat: there is no file '{manifest}'")
    if b'"folder":' not in manifest.read_bytes():
        raise Failure(f"repeat: '{manifest}' is not the manifest of a run: ./collektive run runs scenario files")
    out = arguments.out or f"{manifest.parent.resolve()}-repeated"
    return run_scenario(str(manifest), out=out, overwrite=arguments.overwrite, folder=arguments.folder, trust_jvm=arguments.trust_jvm)
