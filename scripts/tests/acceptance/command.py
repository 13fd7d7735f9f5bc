"""Runs ./collektive for the acceptance tests."""
import atexit
import contextlib
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from build import inputs, lock, projects
from build.jdk import find_jdk
from build.places import COLLEKTIVE, ROOT

HERE = os.path.dirname(os.path.abspath(__file__))
SAMPLE = os.path.join(ROOT, "unity/Samples~/GradientAscent")
# All tests of this process share this folder, so they reuse compiled code.
WORK = tempfile.mkdtemp(prefix="collektive-test-")
atexit.register(shutil.rmtree, WORK, ignore_errors=True)
# A background job of a shell ignores SIGINT. Without this handler, child processes would inherit that.
signal.signal(signal.SIGINT, signal.default_int_handler)


def collektive(*arguments, cwd=None):
    return subprocess.run([COLLEKTIVE, *arguments], cwd=cwd, capture_output=True, text=True)


def last_error(result):
    """Returns the error line of a failed command."""
    lines = [line for line in result.stderr.splitlines() if line.startswith("collektive: ")]
    return lines[-1] if lines else result.stderr


def processes(*words):
    """Returns the command lines of the processes that contain all words, by process id."""
    found = {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/cmdline", "rb") as file:
                line = file.read().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if all(word in line for word in words):
            found[int(pid)] = line
    return found


def jdk():
    """Returns the JDK that runs simulations."""
    return str(find_jdk())


def compiled(compile_part, *parts):
    """Compiles a part of a project. Afterwards releases the lock on the outputs, because commands that the test starts may have to build."""
    try:
        return str(compile_part(*parts))
    finally:
        lock.release()


class Folder(unittest.TestCase):
    """A test case with an empty folder for each test."""

    def setUp(self) -> None:
        self.folder = os.path.join(WORK, "test")
        os.mkdir(self.folder)
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(self.end_processes)

    def end_processes(self) -> None:
        """Kills processes that a failed test left running."""
        for pid in processes(self.folder + "/"):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def wait_until(self, holds) -> None:
        """Waits until holds() returns true, for at most a minute."""
        end = time.monotonic() + 60
        while not holds():
            self.assertLess(time.monotonic(), end, "the condition must be met within a minute")
            time.sleep(0.05)

    def manifest(self, out):
        with open(os.path.join(out, "manifest.json")) as file:
            return json.load(file)


class Project(Folder):
    """A test case with a project outside the clone, which has its own schema, Kotlin, C# and scenario."""

    def setUp(self) -> None:
        super().setUp()
        shutil.copytree(os.path.join(HERE, "foreign"), self.path("project"))

    def programs_jar(self):
        """Returns the jar of the current programs, which an earlier run must have built."""
        project = Path(self.path("project"))
        return compiled(projects.programs_jar, inputs.schema(project / "light.fbs"), inputs.programs(project / "programs"))

    def change(self, file, old, new) -> None:
        path = self.path("project", file)
        with open(path) as opened:
            text = opened.read()
        self.assertIn(old, text)
        with open(path, "w") as opened:
            opened.write(text.replace(old, new))
