"""Runs a command in a process group, forwards signals to it, and waits for its children."""
import contextlib
import ctypes
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import FrameType

_waiting = False
_interrupted_at = -math.inf
# Keeps the objects of detached programs, because Python would ignore an interrupt that arrives in Popen.__del__.
_detached_programs: list[subprocess.Popen[bytes]] = []
# Signals that arrive within this time, in seconds, count as one. `timeout` and Slurm signal all processes of a command.
_SAME_SIGNAL = 1
# A constant from linux/prctl.h. With this option, orphaned descendants become children of this process.
_SET_CHILD_SUBREAPER = 36
# The environment variable of programs that may outlive the command.
_DETACHED = "COLLEKTIVE_DETACHED"
_FORWARDED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def run_in_group(main: Callable[[], int]) -> int:
    """Runs `main` in a new process group, and forwards SIGINT, SIGTERM and SIGHUP to the group so that all its processes end.

    Returns the exit code, or 128 plus the number of the signal. If this process is killed, the group ends, too.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    # A detached program may have started this command.
    os.environ.pop(_DETACHED, None)
    _adopt_orphans()
    watched, lifeline = os.pipe()
    # Until it can forward signals, one of them would end this process, but not the group.
    unblocked = signal.pthread_sigmask(signal.SIG_BLOCK, _FORWARDED)
    group = os.fork()
    if group == 0:
        os.setpgid(0, 0)
        _adopt_orphans()
        os.close(lifeline)
        os.close(watched)
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, _interrupted)
        # Otherwise, a background group that reads from a terminal, or writes to it after `stty tostop`, would stop until it receives SIGCONT.
        for number in (signal.SIGTTIN, signal.SIGTTOU):
            signal.signal(number, signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_SETMASK, unblocked)
        sys.exit(main())
    with contextlib.suppress(OSError):  # the child may already have set its group, or may have ended
        os.setpgid(group, group)
    try:
        watcher = os.fork()
    except OSError:
        os.kill(group, signal.SIGKILL)
        os.waitpid(group, 0)
        raise
    if watcher == 0:
        _watch(watched, lifeline, group)
    with contextlib.suppress(OSError):
        os.setpgid(watcher, watcher)
    os.close(watched)
    received: list[int] = []

    def forward(number: int, _: FrameType | None) -> None:
        received.append(number)
        _end_group(group, signal.SIGINT if number == signal.SIGINT else signal.SIGTERM)

    for number in _FORWARDED:
        # `nohup` ignores SIGHUP, so that a command continues when its terminal is closed.
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, forward)
    signal.pthread_sigmask(signal.SIG_SETMASK, unblocked)
    code = os.waitstatus_to_exitcode(os.waitpid(group, 0)[1])
    # The first process may end before its children. This process then waits for them, because the init process of a container may not reap them.
    while _has_members(group):
        _reap()
        time.sleep(0.02)
    os.close(lifeline)
    _reap(watcher)
    if code < 0:
        code = 128 - code
    return 128 + received[-1] if received and code != 0 else code


def call(command: Sequence[str | Path], env: Mapping[str, str] | None = None, cwd: Path | None = None, stdout: int | None = None) -> int:
    """Runs a command and returns its exit code, or 128 plus the number of the signal that ended it.

    A signal to the process group interrupts the command, but not this function.
    """
    global _waiting
    _waiting = True
    # Flushes earlier output, which must precede the output of the command.
    sys.stdout.flush()
    try:
        # The command must inherit the descriptor of the checkout's lock.
        code = subprocess.Popen(command, env=env, cwd=cwd, stdout=stdout, close_fds=False).wait()
        return code if code >= 0 else 128 - code
    finally:
        _waiting = False


def was_interrupted() -> bool:
    """Returns whether a signal has interrupted this process or a command that `call` ran."""
    return _interrupted_at > 0


def start_detached(command: Sequence[str | Path]) -> None:
    """Starts a program of the user, such as a browser, which may outlive this command, even after Ctrl-C. Does not wait for it."""
    program = subprocess.Popen(command, env={**os.environ, _DETACHED: "1"}, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    _detached_programs.append(program)


def end_orphans() -> None:
    """Kills the orphans of a program that has ended, except detached ones. They are children of this process because of `run_in_group`."""
    while children := [child for child in Path(f"/proc/self/task/{os.getpid()}/children").read_text().split() if not _is_detached(child)]:
        for child in children:
            os.kill(int(child), signal.SIGKILL)
            os.waitpid(int(child), 0)


def _is_detached(process: str) -> bool:
    try:
        return f"{_DETACHED}=".encode() in Path(f"/proc/{process}/environ").read_bytes()
    except OSError:
        return False


def _adopt_orphans() -> None:
    ctypes.CDLL(None).prctl(_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def _interrupted(_: int, __: FrameType | None) -> None:
    global _interrupted_at
    last, _interrupted_at = _interrupted_at, time.monotonic()
    if not _waiting and _interrupted_at - last > _SAME_SIGNAL:
        raise KeyboardInterrupt


def _watch(watched: int, lifeline: int, group: int) -> None:
    """Ends the group when the watched process has ended, even after SIGKILL."""
    # `timeout -s KILL` kills the whole group of the watched process, which must not include this process.
    os.setpgid(0, 0)
    for number in _FORWARDED:
        signal.signal(number, signal.SIG_IGN)
    os.close(lifeline)
    # Closes the inherited output, because the caller may wait until all of its writers have closed it.
    empty = os.open(os.devnull, os.O_RDWR)
    for descriptor in range(3):
        os.dup2(empty, descriptor)
    os.read(watched, 1)
    _end_group(group, signal.SIGTERM)
    os._exit(0)


def _end_group(group: int, number: signal.Signals) -> None:
    """Sends a signal to a group, and continues its stopped processes, which would not receive it."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, number)
        os.killpg(group, signal.SIGCONT)


def _reap(process: int | None = None) -> None:
    """Waits for the given child, or reaps any child that has ended."""
    with contextlib.suppress(ChildProcessError):
        os.waitpid(process or -1, 0 if process else os.WNOHANG)


def _has_members(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
