"""Writes, renames and deletes files in a sweep's folder. It never follows symbolic links, and deletes only folders with a marker."""
import os
import shutil
import stat
from pathlib import Path
from typing import BinaryIO

MARKER = ".collektive-sweep"
"""The name of the marker file in folders that a sweep has created and may delete."""
PART = ".part"
"""The suffix of unfinished files and folders."""
RECORD = "run.json"
"""The name of the file that makes the folder of a run a finished one."""


def make(folder: str) -> None:
    """Creates a folder if it does not exist."""
    if os.path.islink(folder):
        raise OSError(f"'{folder}' is a symbolic link; remove it, or name another folder with --out")
    os.makedirs(folder, exist_ok=True)


def make_marked(folder: str) -> None:
    """Creates an empty folder with a marker. If an unfinished folder of the same name exists, deletes it first."""
    remove(folder)
    os.mkdir(folder)
    os.close(_open(os.path.join(folder, MARKER), os.O_WRONLY | os.O_CREAT | os.O_EXCL))


def is_marked(folder: str) -> bool:
    """Returns whether a sweep has created the folder."""
    return not os.path.islink(folder) and os.path.isfile(os.path.join(folder, MARKER))


def is_file(path: str) -> bool:
    """Returns whether a path leads to a file. Raises `OSError` if the disk has an error, for which `os.path.isfile` returns False."""
    try:
        return stat.S_ISREG(os.stat(path).st_mode)
    except (FileNotFoundError, NotADirectoryError):
        return False


def deletable_above(folder: str) -> str | None:
    """
    Returns the folder of a run or a bundle that is the given folder or contains it, or None. A resumed sweep may delete such a folder.

    The given folder need not exist yet, because a new sweep marks it.
    """
    path = Path(os.path.realpath(folder))
    for place in (path, *path.parents):
        sweep = place.parent.parent if place.parent.name == "runs" else place.parent if place.name == "bundle" or place.suffix == PART else None
        if sweep and (place == path or is_marked(str(place))) and is_marked(str(sweep)):
            return str(place)
    return None


def remove(folder: str) -> None:
    """
    Deletes a marked or empty folder if it exists.

    Deletes the record first, so that no folder with a record is incomplete, and the marker last, so that an interrupted deletion can be repeated.
    """
    if not os.path.lexists(folder):
        return
    if os.path.islink(folder) or not os.path.isdir(folder) or (os.listdir(folder) and not is_marked(folder)):
        raise OSError(f"'{folder}' was not created by a sweep; move it, or name another folder with --out")
    for entry in sorted(os.scandir(folder), key=lambda entry: entry.name != RECORD):
        if entry.is_dir(follow_symlinks=False):
            shutil.rmtree(entry.path)
        elif entry.name != MARKER:
            os.unlink(entry.path)
    if is_marked(folder):
        os.unlink(os.path.join(folder, MARKER))
    os.rmdir(folder)


def create(path: str) -> BinaryIO:
    """Opens an unfinished file, which `publish` renames to `path`."""
    part = path + PART
    if os.path.lexists(part):
        os.unlink(part)
    return os.fdopen(_open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL), "wb")


def publish(path: str) -> None:
    """Syncs an unfinished file or folder to the disk and renames it to `path`, which must not be an existing folder."""
    part = path + PART
    if os.path.isdir(part):
        for folder, _, names in os.walk(part):
            for name in names:
                # Scripts can create pipes, and opening a pipe would wait for its writer.
                if stat.S_ISREG(os.lstat(os.path.join(folder, name)).st_mode):
                    _sync(os.path.join(folder, name))
            _sync(folder)
    else:
        _sync(part)
    os.replace(part, path)
    _sync(os.path.dirname(os.path.abspath(path)))


def write(path: str, text: str) -> None:
    """Writes a file atomically."""
    with create(path) as file:
        file.write(text.encode())
    publish(path)


def write_part(path: str, text: str) -> None:
    """Writes a file into an unfinished folder. `publish` syncs it together with the folder."""
    with create(path) as file:
        file.write(text.encode())
    os.replace(path + PART, path)


def open_log(path: str) -> BinaryIO:
    """Opens a log or lock file for appending. It is also readable, because shared locks on NFS need this."""
    return os.fdopen(_open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND), "ab")


def _open(path: str, flags: int) -> int:
    return os.open(path, flags | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)


def _sync(path: str) -> None:
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
