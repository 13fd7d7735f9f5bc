"""Manages the record of a live run, which begins with its first tick. docs/record-format.md describes the format."""
import contextlib
import os
import shutil
import struct
import zlib
from pathlib import Path

from build.console import Failure
from live.session import new_file

# The content of a record that becomes larger is deleted.
MAX_BYTES = 1_000_000_000
_MAGIC_BYTES = 8
_CHUNK = struct.Struct("<4sII")


class Record:
    """A record to which the player is writing."""

    def __init__(self, path: Path, maximum: int = MAX_BYTES) -> None:
        self._path = path
        self._maximum = maximum
        self._is_deleted = False

    def begin(self) -> None:
        """Deletes the previous record, and begins a new one."""
        self._is_deleted = False
        self._path.unlink(missing_ok=True)

    def limit(self) -> bool:
        """Deletes the content of the record if it is too large. Returns whether this is the first deletion."""
        with contextlib.suppress(FileNotFoundError):
            # Compares blocks, because after a deletion the file begins with a hole, which adds to its size but occupies no blocks.
            if 512 * self._path.stat().st_blocks > self._maximum:
                was_deleted, self._is_deleted = self._is_deleted, True
                try:
                    os.truncate(self._path, 0)
                except OSError:
                    self._is_deleted = was_deleted
                    raise
                return not was_deleted
        return False

    @property
    def deletion(self) -> str:
        return f"the record exceeded {self._maximum / 1e9:g} GB and was deleted; press Restart to begin another one"

    def save(self, target: Path) -> None:
        """Copies all finished ticks to a new file, and adds the end of a record.

        Raises `Failure` if no tick is finished or the record was deleted, and `FileExistsError` if the file or link exists.
        """
        end = self._end()
        with self._path.open("rb") as source, new_file(target) as output:
            shutil.copyfileobj(source, output)
            self._require_kept()
            output.truncate(end)
            output.seek(end)
            head = struct.pack("<4sI", b"END ", 0)
            output.write(head + struct.pack("<I", zlib.crc32(head)))

    def _require_kept(self) -> None:
        # The record may become too large while it is read.
        if self._is_deleted:
            raise Failure(self.deletion)

    def _end(self) -> int:
        """Returns the position in the file after the last finished tick."""
        at, end = _MAGIC_BYTES, 0
        if self._path.exists():
            with self._path.open("rb") as source:
                size = os.fstat(source.fileno()).st_size
                # After a deletion, the file begins with zeros.
                while at + _CHUNK.size <= size and not self._is_deleted:
                    source.seek(at)
                    kind, length, _ = _CHUNK.unpack(source.read(_CHUNK.size).ljust(_CHUNK.size))
                    at += _CHUNK.size + length
                    if at <= size and kind in (b"DONE", b"FAIL"):
                        end = at
        self._require_kept()
        if end == 0:
            raise Failure("the run has not finished a tick yet")
        return end
