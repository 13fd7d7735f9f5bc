"""Checks the results of a demo."""
import csv
import json
import os
from collections.abc import Callable

from tests import junit


class Demo:
    """The results of a demo. Each check returns an error, or None."""

    def __init__(self, folder: str, code: int) -> None:
        self.folder, self.code = folder, code

    def read(self, name: str) -> bytes:
        with open(os.path.join(self.folder, name), "rb") as file:
            return file.read()

    def ended(self) -> str | None:
        return None if self.code == 0 else f"it ended with {self.code}"

    def manifest(self) -> str | None:
        ran = json.loads(self.read("manifest.json"))
        return None if (ran["ticks"], ran["nodes"], ran["errors"]) == (1200, 500, 0) else f"{ran['ticks']} ticks, {ran['nodes']} nodes, {ran['errors']} errors"

    def metrics(self) -> str | None:
        rows = list(csv.reader(self.read("metrics.csv").decode().splitlines()))
        return None if len(rows) > 60 and len({len(row) for row in rows}) == 1 else f"{len(rows)} rows"

    def pictures(self) -> str | None:
        bad = [name for name in ("start.png", "middle.png", "end.png") if self.read(name)[:8] != b"\x89PNG\r\n\x1a\n" or len(self.read(name)) < 50_000]
        return None if not bad else f"no picture: {bad}"

    def page(self) -> str | None:
        html = self.read("replay.html")
        return None if b'id="replay"' in html and len(html) > 500_000 else f"{len(html)} bytes"


def case(name: str, check: Callable[[], str | None]) -> junit.Case:
    try:
        return junit.Case(name, check() or "")
    except (OSError, ValueError, KeyError) as error:
        return junit.Case(name, repr(error))


def check(folder: str, code: int, results: str) -> None:
    """Checks the results of a demo that has ended with an exit code, and writes a JUnit XML file."""
    demo = Demo(folder, code)
    junit.write(results, "demo", [
        case("the exit code is 0", demo.ended),
        case("the manifest has 500 nodes, 1200 ticks and 0 errors", demo.manifest),
        case("metrics.csv has all rows", demo.metrics),
        case("the demo has three pictures", demo.pictures),
        case("the demo has a replay page", demo.page),
    ])
