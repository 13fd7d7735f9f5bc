"""Lists the files of users' projects that the compilers read. Cache keys, manifests and bundles of sweeps all use these lists."""
import hashlib
import os
import re
import shutil
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise
from pathlib import Path

from build.console import Failure
from build.places import ROOT

MAX_FILES = 10_000
# The folder of types.fbs, which schemas include without a path.
CORE = ROOT / "schema"
_TOKEN = re.compile(rb"""//[^\r\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'|\w+|\S""", re.DOTALL)


class Part:
    """The files that one key of a scenario names, by relative path, and a hash of their paths and contents."""

    def __init__(self, path: Path, list_files: Callable[[Path], dict[str, Path]]) -> None:
        self.path = Path(os.path.abspath(path))
        self.files: Mapping[str, Path] = list_files(self.path)
        for file in self.files.values():
            # The C# compiler removes '|' from paths.
            if re.search(r"[\n\r\udc80-\udcff]|\|.*\.cs$", str(file)):
                raise Failure(f"the path {str(file)!r} has a line break or '|', or is not UTF-8, which compilers cannot read: rename the file or its folders")
            # Reading a pipe or a device might never end.
            if file.exists() and not file.is_file():
                raise Failure(f"'{file}' is not a file: remove or rename it")
        self._times = _change_times(self.files)
        self.digest = _digest(self.files)
        self._list_files = list_files

    @property
    def folder(self) -> Path:
        """The folder to which the paths of the files are relative."""
        return self.path if self.path.is_dir() else self.path.parent

    @property
    def root(self) -> Path:
        """The folder that contains all files. It is above `folder` if a path begins with `..`."""
        up = max((Path(name).parts.count("..") for name in self.files), default=0)
        return (self.folder / "_").parents[up]

    def copy(self, target: Path) -> Path:
        """Copies the files, and the targets of links, to a folder with their paths relative to `root`. Returns the copy of `path`."""
        target.mkdir(parents=True, exist_ok=True)
        for name, file in self.files.items():
            copy = target / os.path.relpath(self.folder / name, self.root)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)
        return target / self.path.relative_to(self.root)

    def require_unchanged(self) -> None:
        """Raises `Failure` if a file was changed, even temporarily, added or removed since this part was read."""
        if self.is_changed() or _digest(self._list_files(self.path)) != self.digest:
            raise Failure(f"'{self.path}' changed during compilation: run the command again")

    def is_changed(self) -> bool:
        """Returns whether the change times of files differ, or files were added or removed, since this part was read."""
        return _change_times(self._list_files(self.path)) != self._times


def scripts(folder: Path) -> Part:
    """Reads a folder of C# without generated code, because each run generates it again."""
    return Part(folder, partial(_below, suffixes=(".cs",), excluded=("Generated", "obj")))


def programs(path: Path) -> Part:
    """Reads a jar, or a folder with Kotlin files. Raises `Failure` for one Kotlin file, and for Java files in the folder, which would not be compiled."""
    if path.suffix == ".kt" and path.is_file():
        raise Failure(f"'programs' is the file {path}: name its folder, or a jar")
    if not path.is_dir():
        return jar(path)
    for file in _below(path, (".java",)).values():
        raise Failure(f"{file}: only Kotlin is compiled: convert this Java file to Kotlin, or move it to another folder")
    return Part(path, partial(_below, suffixes=(".kt",)))


def jar(path: Path) -> Part:
    """Reads a jar."""
    return Part(path, lambda file: {file.name: file})


def jars(folder: Path) -> Part:
    """Reads the jars of a folder, but not of its subfolders."""
    return Part(folder, lambda place: {file.name: file for file in sorted(place.glob("*.jar"))})


def schema(file: Path) -> Part:
    """Reads a schema and the files that it includes, except files of the package."""
    return Part(file, _with_includes)


def data(folder: Path) -> Part:
    """Reads a folder of data files, which the scene reads."""
    return Part(folder, partial(_below, suffixes=("",)))


def _change_times(files: Mapping[str, Path]) -> dict[str, tuple[int, int]]:
    """Returns the change times of files, and of links to them. Unlike modification times, programs cannot set them back."""
    return {name: (file.stat().st_ctime_ns, file.lstat().st_ctime_ns) for name, file in files.items()}


def _digest(files: Mapping[str, Path]) -> str:
    total = hashlib.sha256()
    for name, file in files.items():
        total.update(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {name}\0".encode(errors="surrogateescape"))
    return total.hexdigest()


def _below(folder: Path, suffixes: tuple[str, ...], excluded: tuple[str, ...] = ()) -> dict[str, Path]:
    """Returns the files below a folder, sorted by name. Follows links, except links to a folder that contains the link itself."""
    found: dict[str, Path] = {}
    count = 0
    pending: list[tuple[str, str, frozenset[str]]] = [("", str(folder), frozenset({os.path.realpath(folder)}))]
    while pending:
        prefix, place, above = pending.pop()
        for entry in os.scandir(place):
            count += 1
            if count > MAX_FILES:
                # Without this limit, hashing a whole disk by mistake would look like a hang.
                raise Failure(f"the folder '{folder}' has more than {MAX_FILES:,} files: name a folder that contains only the sources of this scenario")
            real = os.path.realpath(entry.path)
            if os.path.isdir(real):
                if entry.name not in excluded and real not in above:
                    pending.append((f"{prefix}{entry.name}/", entry.path, above | {real}))
            elif entry.name.endswith(suffixes) and os.path.isfile(real):
                found[prefix + entry.name] = Path(entry.path)
    return dict(sorted(found.items()))


def _with_includes(schema: Path) -> dict[str, Path]:
    """Returns a schema and the files that it includes.

    Like flatc, this searches for an included file beside the including file, in the package, and beside the schema.
    """
    found: dict[str, Path] = {}
    folder = str(schema.parent)
    pending = [str(schema)]
    while pending:
        file = pending.pop()
        name = os.path.relpath(file, folder)
        if name in found:
            continue
        found[name] = Path(file)
        for include in _includes(file):
            # Like flatc, this appends even an absolute path to each place.
            candidates = {place: f"{place}/{include}" for place in (os.path.dirname(file), str(CORE), folder)}
            for candidate in candidates.values():
                # flatc would wait for the writer of a pipe.
                if os.path.exists(candidate) and not os.path.isfile(candidate) and not os.path.isdir(candidate):
                    raise Failure(f"{file}: the include '{include}' is not a file")
            place = next((place for place, candidate in candidates.items() if os.path.isfile(candidate)), str(CORE))
            if place == str(CORE):
                continue
            included = os.path.normpath(candidates[place])
            if os.path.realpath(os.path.dirname(included)) != os.path.realpath(os.path.dirname(candidates[place])):
                raise Failure(f"{file}: the include \"{include}\" goes up from a linked folder: write the path without '..'")
            pending.append(included)
    return dict(sorted(found.items()))


def _includes(file: str) -> list[str]:
    """Returns the paths that a schema file includes."""
    tokens = [token for token in _TOKEN.findall(Path(file).read_bytes()) if not token.startswith((b"//", b"/*"))]
    paths = [after[1:-1] for token, after in pairwise(tokens) if token == b"include" and len(after) > 1 and after[:1] in b"\"'"]
    for path in paths:
        if b"\\" in path:
            raise Failure(f"{file}: an include has a backslash: write the path with '/'")
    return [os.fsdecode(path) for path in paths]
