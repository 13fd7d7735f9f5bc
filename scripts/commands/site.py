"""Builds the documentation site in --out from Documentation~, docs/ and a reference generated from the code. Open index.html in a browser; the
site needs neither a server nor the internet. Broken links are errors."""
import argparse
import os
import shutil
import tempfile
from pathlib import Path

from build import fetch, graph
from build.console import Failure, run_logged
from build.places import BUILD, ROOT
from build.site import pages

TOOLS = BUILD / "site-tools"
# A folder with this file may be replaced.
MARKER = ".collektive-site"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", type=Path, default=ROOT / "out/site", metavar="DIR",
                        help="folder for the site (default: out/site), replacing an earlier site")


def run(arguments: argparse.Namespace) -> int:
    out: Path = arguments.out
    require_replaceable(out)
    graph.build("documentation")
    fetch.fetch("site-tools")
    # In its own folder first, so that several commands can build at once.
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        pages.write(work, TOOLS / "node_modules")
        run_logged("site", [TOOLS / "bin/python", "-I", "-m", "mkdocs", "build", "--strict", "--config-file", "site.yml", "--site-dir", "site"], cwd=work,
               env={**os.environ, "NO_MKDOCS_2_WARNING": "true"})
        (work / "site" / MARKER).touch()
        replace(work / "site", out)
    print(out / "index.html")
    return 0


def require_replaceable(out: Path) -> None:
    """Raises `Failure` if `out` exists and is not a site built by this command, or is also a Git working tree."""
    if os.path.lexists(out) and (out.is_symlink() or not (out / MARKER).is_file()):
        raise Failure(f"site: '{out}' exists and is not a site built by this command: name another folder with --out, or remove it")
    if os.path.lexists(out / ".git"):
        raise Failure(f"site: '{out}' is a Git working tree, whose history would be deleted: name another folder with --out, and copy the site")


def replace(site: Path, out: Path) -> None:
    """Copies a site to `out`, in place of an earlier site, which stays if the copy fails."""
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{out.name}.", dir=out.parent) as part:
        try:
            shutil.copytree(site, Path(part, "new"))
        except shutil.Error as error:
            raise Failure(f"site: cannot write '{out}': {error.args[0][0][2]}") from error
        # The folder may have appeared during the build.
        require_replaceable(out)
        if out.exists():
            out.rename(Path(part, "earlier"))
        Path(part, "new").rename(out)
