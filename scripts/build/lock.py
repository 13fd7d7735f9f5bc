"""A lock on the build outputs of this checkout, which several processes can share."""
import fcntl
import os
from collections.abc import Callable

from build.console import print_progress
from build.places import BUILD, ROOT

_descriptor: int | None = None


def shared() -> None:
    """Locks the outputs for use until this process ends. Child processes share the lock."""
    _acquire(fcntl.LOCK_SH)


def exclusive() -> None:
    """Locks the outputs for changes. If it has to wait for other commands, prints a message."""
    _acquire(fcntl.LOCK_EX)


def change(is_done: Callable[[], bool], make: Callable[[], None]) -> None:
    """Calls `make` with the outputs locked for changes, unless `is_done` returns true. Then locks the outputs for use.

    If two commands need the same change, the second one waits only for `make`, and not for the rest of the first command.
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
            # This fails if the checkout is read-only or belongs to another user.
            BUILD.mkdir(exist_ok=True)
            os.utime(BUILD)
            make()
        finally:
            shared()
    finally:
        os.close(changes)


def release() -> None:
    """Releases the lock, for commands whose child processes lock the outputs themselves."""
    global _descriptor
    if _descriptor is not None:
        os.close(_descriptor)
        _descriptor = None


def _acquire(mode: int) -> None:
    global _descriptor
    if _descriptor is None:
        # The lock is on the folder of the checkout, because `clean` removes every file that could carry it.
        _descriptor = os.open(ROOT, os.O_RDONLY)
        # Children inherit the lock, because a run can outlive a killed command and still use the outputs.
        os.set_inheritable(_descriptor, True)
    _wait(_descriptor, mode)


def _wait(descriptor: int, mode: int) -> None:
    try:
        fcntl.flock(descriptor, mode | fcntl.LOCK_NB)
    except BlockingIOError:
        print_progress("waiting for another collektive command that uses build/ ...")
        fcntl.flock(descriptor, mode)
