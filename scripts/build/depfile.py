"""Declares that an output of the build graph depends on all files and folders below FOLDER: `depfile.py OUTPUT DEPFILE FOLDER...`.

Ninja reads DEPFILE, which has the format of make. Folders are included because adding or removing a file changes the time of its folder.
"""
import sys
from pathlib import Path

IGNORED = {"target", "build", "node_modules", ".git", "__pycache__"}


def inputs(folders: list[Path]) -> list[Path]:
    """Returns all files and folders below some folders, except build outputs and Unity's metas."""
    found: list[Path] = []
    for folder in folders:
        if not folder.is_dir():
            found.append(folder)
            continue
        found.append(folder)
        for path in sorted(folder.iterdir()):
            if path.name not in IGNORED and path.suffix != ".meta":
                found += inputs([path])
    return found


def write(output: Path, depfile: Path, folders: list[Path]) -> None:
    """Writes the dependencies of an output."""
    lines = [str(path).replace(" ", "\\ ").replace("#", "\\#").replace("$", "$$") for path in inputs(folders)]
    depfile.parent.mkdir(parents=True, exist_ok=True)
    depfile.write_text(f"{str(output).replace(' ', chr(92) + ' ')}: " + " \\\n  ".join(lines) + "\n")


if __name__ == "__main__":
    write(Path(sys.argv[1]), Path(sys.argv[2]), [Path(folder) for folder in sys.argv[3:]])
