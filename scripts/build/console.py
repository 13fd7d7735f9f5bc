"""Progress messages, and logs of long steps."""
import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from build.places import LOGS

# Commands that other commands start continue the first one's clock.
STARTED = float(os.environ.setdefault("COLLEKTIVE_STARTED", str(time.time())))
_step = ""


class Failure(Exception):
    """Ends the command with a message and an exit code. The default is the command's exit code for errors."""

    def __init__(self, message: str, code: int | None = None) -> None:
        super().__init__(message)
        self.code = code


def print_progress(text: str) -> None:
    """Prints progress, after the seconds since the start."""
    print(f"[{time.time() - STARTED:4.0f}s] {text}", file=sys.stderr, flush=True)


def run_logged(name: str, command: Sequence[str | Path], cwd: Path | None = None, env: Mapping[str, str] | None = None, log: Path | None = None) -> None:
    """Runs a command with its output in a log file, and prints the log if the command fails. Successive commands of one name share a log.

    Raises `Failure` if the exit code is not 0.
    """
    global _step
    path = log or LOGS / f"{name}.log"
    path.parent.mkdir(parents=True, exist_ok=True)
    mode = "a" if name == _step else "w"
    if name != _step:
        print_progress(f"{name} ...")
    _step = name
    with path.open(mode, encoding="utf-8") as file:
        code = subprocess.run(command, cwd=cwd, env=env, stdin=subprocess.DEVNULL, stdout=file, stderr=file).returncode
    if code == 0:
        return
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    # Compilers print the cause first, other tools last.
    shown = lines if len(lines) <= 60 else [*lines[:30], "...", *lines[-30:]]
    print("\n".join(shown), file=sys.stderr)
    raise Failure(f"{name} failed; the full log is {path}")
