"""Provides a copy of the scripts, whose outputs tests can lock, build and remove."""
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

from build.places import ROOT

SETUP = """
import signal
import sys
from pathlib import Path
root = Path(sys.argv[1])
sys.path.insert(0, str(root / "scripts"))
from build import fetch, graph, lock, processes
from build.console import Failure, run_logged

def wait_at_gate():
    (root / "gate").read_bytes()

def make(folder):
    with open(root / "made", "a") as file:
        file.write(f"made, {len(list(folder.iterdir()))} files there\\n")
    (folder / "half").touch()
    wait_at_gate()
"""


class Checkout:
    """A checkout whose folder has a space in its name."""

    def __init__(self, folder: Path) -> None:
        self.root = folder / "a b"
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / "scripts", self.root / "scripts", ignore=ignored)
        for path in ("collektive", "jvm-host/pom.xml", "experiments/collektive_experiments/options.py"):
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / path, self.root / path)
        self.open_gate()

    def open_gate(self) -> None:
        """Lets `wait_at_gate` return immediately."""
        (self.root / "gate").unlink(missing_ok=True)
        (self.root / "gate").touch()

    def close_gate(self) -> None:
        """Makes `wait_at_gate` wait until the gate has been opened and closed."""
        (self.root / "gate").unlink()
        os.mkfifo(self.root / "gate")

    def start(self, code: str) -> subprocess.Popen[str]:
        """Starts a program that uses the scripts, in a separate process group that can be killed as a whole."""
        return self._popen([sys.executable, "-I", "-c", SETUP + code, str(self.root)])

    def start_command(self, *words: str) -> subprocess.Popen[str]:
        return self._popen([str(self.root / "collektive"), *words])

    def run(self, code: str) -> subprocess.CompletedProcess[str]:
        process = self.start(code)
        output, errors = process.communicate(timeout=120)
        return subprocess.CompletedProcess(process.args, process.returncode, output, errors)

    def log_lines(self) -> list[str]:
        """Returns the lines that `make` has written."""
        return (self.root / "made").read_text().splitlines()

    @staticmethod
    def kill(process: subprocess.Popen[str]) -> None:
        """Kills a program and its children."""
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    @staticmethod
    def _popen(command: list[str]) -> subprocess.Popen[str]:
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
