"""Prints progress messages, and writes the output of long steps to logs."""
import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from build import processes
from build.places import LOGS

# A command that another command starts continues the clock of that command.
STARTED = float(os.environ.setdefault("COLLEKTIVE_STARTED", str(time.monotonic())))
_steps: set[str] = set()


class Failure(Exception):
    """Ends the command with a message and an exit code, by default the code that the command uses for errors."""

    def __init__(self, message: str, code: int | None = None) -> None:
        super().__init__(message)
        self.code = code


def print_progress(text: str) -> None:
    """Prints a progress message that begins with the seconds since the start."""
    print(f"[{time.monotonic() - STARTED:4.0f}s] {text}", file=sys.stderr, flush=True)


def run_logged(name: str, command: Sequence[str | Path], cwd: Path | None = None, env: Mapping[str, str] | None = None, log: Path | None = None) -> None:
    """Runs a command and writes its output to a log file. Commands with the same name share a log.

    If the exit code is not 0, raises `Failure`, and prints the log unless a signal interrupted the command.
    """
    path = log or LOGS / f"{name}.log"
    path.parent.mkdir(parents=True, exist_ok=True)
    mode = "a" if name in _steps else "w"
    if name not in _steps:
        print_progress(f"{name} ...")
    _steps.add(name)
    with path.open(mode, encoding="utf-8") as file:
        code = subprocess.run(command, cwd=cwd, env=env, stdin=subprocess.DEVNULL, stdout=file, stderr=file).returncode
    if code == 0:
        return
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    # Compilers print the cause of an error first, and other tools print it last.
    shown = lines if len(lines) <= 60 else [*lines[:30], "...", *lines[-30:]]
    # After Ctrl-C, the log ends with the interruption of the tool.
    if not processes.was_interrupted():
        print("\n".join(shown), file=sys.stderr)
    raise Failure(f"{name} failed; the full log is {path}")
