#!/usr/bin/env python3
"""outputs.py FOLDER [--overwrite]: prepares the folder that a run writes to. Results of a former run in it are refused, or removed with --overwrite:
what lies there afterwards is of one run. Prints what is wrong in one line and ends with 1."""
import os
import sys
import tempfile

RESULTS = ("manifest.json", "metrics.csv", "nodes.csv", "replay.html", "run.clkrec", "start.png", "middle.png", "end.png")
UNFINISHED = tuple(name + ".part" for name in RESULTS) + ("replay.tmp",)


class RefusedError(Exception):
    """Why a run cannot write to a folder."""


def prepare(folder: str, overwrite: bool) -> None:
    try:
        former = [name for name in RESULTS if os.path.lexists(os.path.join(folder, name))]
        if former and not overwrite:
            raise RefusedError(f"'{folder}' has results of a run: {', '.join(former)}; name another folder with --out, or add --overwrite")
        for name in former + [name for name in UNFINISHED if os.path.lexists(os.path.join(folder, name))]:
            os.remove(os.path.join(folder, name))
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise RefusedError(f"the outputs cannot be written to '{folder}': {error.strerror}; name another folder with --out") from error


def main(words: list[str]) -> int:
    try:
        prepare(words[0], "--overwrite" in words[1:])
    except RefusedError as refused:
        print(f"collektive: {refused}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
