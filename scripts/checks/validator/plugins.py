"""Checks that no version of Unity copies two native libraries of the packages to the same path in a player."""
import itertools
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from build import manifest, metas
from build.places import ROOT
from build.platforms import PLATFORMS

# The first version of Unity whose Linux players have a folder for each processor. Some releases of 6000.3 and 6000.4 have these folders, too.
LINUX_FOLDERS = (6000, 5)


class Library(NamedTuple):
    """A native library in a package: its path, its .meta, and the first version of Unity that the package supports."""

    path: str
    meta: str
    unity: str

    @property
    def players(self) -> dict[str, str]:
        """The platforms of the players that contain the library, and the processor for each."""
        return dict(re.findall(r"first:\n +Standalone: (\w+)\n +second:\n +enabled: 1\n +settings:\n +CPU: (\w+)", self.meta))


def problems(libraries: Iterable[Library]) -> Iterator[str]:
    """Yields a line for each pair of libraries that would have the same path in a player."""
    for one, other in itertools.combinations(libraries, 2):
        if Path(one.path).name != Path(other.path).name:
            continue
        # The first version of Unity in which both packages can be installed.
        first = max(_number(one.unity), _number(other.unity))
        for player in sorted(one.players.keys() & other.players.keys()):
            has_folders = player != "Linux64" or first >= LINUX_FOLDERS
            if not has_folders or one.players[player] == other.players[player]:
                yield f"{one.path}: collides with {other.path} in {player} players of Unity {'.'.join(map(str, first))}"


def packaged() -> list[Library]:
    """Returns the native libraries of the published packages."""
    core = manifest.read(ROOT)
    return [Library(f"Plugins/{platform}/{PLATFORMS[platform].library}", metas.native(platform), manifest.WITH_LIBRARY.get(platform, core["unity"]))
            for platform in metas.NATIVE]


def _number(version: str) -> tuple[int, ...]:
    return tuple(map(int, version.split(".")))
