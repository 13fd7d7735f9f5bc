"""The lock on the build outputs of this checkout."""
import fcntl
import os
from collections.abc import Callable

from build.console import say
from build.places import BUILD, ROOT

_descriptor: int | None = None


def shared() -> None:
    """Locks the outputs for use until this process ends. Processes that it starts share the lock."""
    _acquire(fcntl.LOCK_SH)


def exclusive() -> None:
    """Locks the outputs for changes. Waits for other commands, and reports that."""
    _acquire(fcntl.LOCK_EX)


def change(is_done: Callable[[], bool], make: Callable[[], None]) -> None:
    """Calls `make` with the outputs locked for changes, unless it `is_done`, and locks them for use.

    Of two commands that need the same, the second waits for `make` only, not for what the first one does afterwards.
    """
    shared()
    if is_done():
        return
    assert _descriptor is not None
    changes = os.open(ROOT / "scripts", os.O_RDONLY)
    try:
        fcntl.flock(_descriptor, fcntl.LOCK_UN)
        _wait(changes, fcntl.LOCK_EX)
        shared()
        if is_done():
            return
        exclusive()
        try:
            # Fails in a checkout that belongs to somebody else, or is read-only.
            BUILD.mkdir(exist_ok=True)
            os.utime(BUILD)
            make()
        finally:
            shared()
    finally:
        os.close(changes)


def release() -> None:
    """Releases the lock: for commands that only start other commands, each of which locks by itself."""
    global _descriptor
    if _descriptor is not None:
        os.close(_descriptor)
        _descriptor = None


def _acquire(mode: int) -> None:
    global _descriptor
    if _descriptor is None:
        # The folder itself is locked: `clean` removes every file that could carry the lock.
        _descriptor = os.open(ROOT, os.O_RDONLY)
        # A run outlives a command that is killed, and still uses the outputs.
        os.set_inheritable(_descriptor, True)
    _wait(_descriptor, mode)


def _wait(descriptor: int, mode: int) -> None:
    try:
        fcntl.flock(descriptor, mode | fcntl.LOCK_NB)
    except BlockingIOError:
        say("waiting for another collektive command that uses build/ ...")
        fcntl.flock(descriptor, mode)
