"""Reads the package's assets by path and by GUID."""
import os
from pathlib import Path

from build import inputs, metas, projects, sample_programs

# GUIDs of Unity's built-in meshes, materials and shaders.
BUILT_IN = {"0000000000000000e000000000000000", "0000000000000000f000000000000000"}


class Assets:
    """The assets below a root."""

    def __init__(self, root: str | Path) -> None:
        self.root = root
        self.paths = list(metas.assets(root))
        self.guids: dict[str, str] = {}
        for path in self.paths:
            guid = guid_of(os.path.join(root, path + ".meta"))
            if guid:
                self.guids[guid] = path
        # The names of the programs in each library that is staged with the samples, by the library's path.
        self.libraries: dict[str, set[str]] = {}
        for schema in Path(root, "unity/Samples~").glob("*/*.fbs"):
            path = os.path.relpath(schema.with_suffix(".clkprograms"), root)
            self.guids[metas.guid_for(path)] = path
            self.libraries[path] = projects.program_names(inputs.programs(sample_programs.folder(schema))) or set()

    def with_ending(self, *endings: str) -> list[str]:
        return [path for path in self.paths if path.endswith(endings)]

    def read(self, path: str) -> str:
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            return file.read()


def guid_of(meta: str) -> str | None:
    """Returns the GUID in a meta file, or None if the file has none."""
    if not os.path.exists(meta):
        return None
    with open(meta) as file:
        return metas.guid_in(file.read())
