"""Runs scenarios in player processes."""
import contextlib
import glob
import json
import os
import secrets
import select
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

from . import files
from .bundle import programs_jar
from .experiment import RUNTIME
from .programs import can_leave_state

MAX_TAIL = 4000
TIMES = ("queries_ms", "rules_ms", "sense_ms", "step_ms", "act_ms", "physics_ms", "other_ms", "tick_ms", "tick_ms_p99")
"""The last columns of metrics.csv."""
MAX_START_SECONDS = 120.0
"""The time limit in seconds until a new process accepts runs."""
MAX_EXIT_SECONDS = 2.0
REPEATED = "repeated"
"""The folder of a repetition inside the run's folder. It is deleted after the comparison."""


class WorkerError(Exception):
    """A worker could not be started."""


@dataclass(frozen=True)
class Outcome:
    """The outcome of a run."""
    status: str
    """`complete`, `failed` (with an error), `crashed` (the process ended), `timeout`, or `differs` (the repetition gave a different result)."""
    message: str = ""


class _Process:
    """
    A process of the player. It starts a JVM, unless it only checks keys.

    Requests and responses use a socket, which children of the process do not inherit. The process writes its output to a log, and ends when the socket is
    closed.
    """

    def __init__(self, bundle: str, log: str, trust: bool, settings: str | None):
        self.settings = settings
        self.is_fresh = True
        self._log = log
        self._pending = b""
        self._keeps_state: bool | None = None
        bundle = os.path.abspath(bundle)
        jar = os.path.join(bundle, "jars/collektive-host.jar")
        with open(os.path.join(bundle, "inputs.json"), encoding="utf-8") as file:
            hashes = json.load(file)["hashes"]
        start = json.loads(settings or "{}")
        runtime = start.get(RUNTIME, "")
        inputs = json.dumps({key: value for key, value in hashes.items() if runtime.lower() != "builtin" or key not in ("runtimeJars", "runtimePlugin")})
        # Runs whose scripts or programs use relative paths must not find the files of other processes.
        self._folder = f"{os.path.abspath(log).removesuffix('.txt')}-{secrets.token_hex(4)}"
        self._channel, child_end = socket.socketpair()
        with child_end, files.open_log(log) as output:
            os.mkdir(self._folder)
            self._process = subprocess.Popen(
                ["mono-sgen", "--debug", os.path.join(bundle, "csharp/Collektive.Player.exe"), "serve", os.path.join(bundle, "inputs/scenario.json"),
                 "--scripts", os.path.join(bundle, "Scenario.dll"), "--jar", programs_jar(bundle, runtime),
                 # The path is relative, because a class path cannot contain colons, and the path of the bundle may contain them.
                 "--host-jar", os.path.relpath(os.path.realpath(jar), os.path.realpath(self._folder)),
                 "--java-home", java_home(), "--channel", str(child_end.fileno()), "--inputs", inputs, *(["--trust-jvm"] if trust else [])],
                stdin=subprocess.DEVNULL, stdout=output, stderr=output, cwd=self._folder, start_new_session=True, pass_fds=[child_end.fileno()],
                # Nodes of a cluster may have different settings, with which scripts and programs would have different results.
                env={**os.environ, "LC_ALL": "C.UTF-8", "TZ": "UTC", "MONO_ENV_OPTIONS": "", "MONO_CRASH_NOFILE": "1"})
        self._pids = {self._process.pid}
        self._ready = "" if settings is None else self._send({"start": True, "set": start})

    def keeps_state(self) -> bool | Outcome:
        """Waits until the process accepts runs. Returns whether its scripts may keep state between runs, or the outcome if the process ended."""
        if self._keeps_state is None:
            answer = self._receive(self._ready, MAX_START_SECONDS)
            if isinstance(answer, Outcome):
                return answer
            self._keeps_state = answer["keepsState"] is not None
        return self._keeps_state

    def request(self, request: dict[str, Any], limit: float) -> dict[str, Any] | Outcome:
        """Returns the response to a request, or the outcome if the process ended."""
        return self._receive(self._send(request), limit)

    def kill(self) -> None:
        """Kills the process and its children. Any thread may call this method."""
        for path in glob.glob("/proc/[0-9]*/stat"):
            with contextlib.suppress(OSError), open(path, "rb") as file:
                pid, (_, _, _, session, *_) = path.split("/")[2], file.read().rpartition(b")")[2].split()
                # Children keep the session when the process has ended.
                if int(session) == self._process.pid:
                    self._pids.add(int(pid))
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def end(self) -> None:
        """Ends the process and waits for its exit."""
        self._channel.close()
        self.kill()
        # The JVM, which may run in a child, would remove this socket in an exit handler. An earlier process of another user may have left one of this name.
        for pid in self._pids:
            with contextlib.suppress(OSError):
                os.unlink(f"/tmp/.java_pid{pid}")
        self._process.wait()
        # A folder that contains files of the runs is kept.
        with contextlib.suppress(OSError):
            os.rmdir(self._folder)

    def _send(self, request: dict[str, Any]) -> str:
        """Sends a request. Returns its id, which is random, so scripts cannot forge a response."""
        identity = secrets.token_hex(8)
        try:
            self._channel.sendall(json.dumps({"id": identity, **request}).encode() + b"\n")
        except OSError:
            pass  # The process has ended. The caller detects this because no response arrives.
        return identity

    def _receive(self, identity: str, limit: float) -> dict[str, Any] | Outcome:
        start = os.path.getsize(self._log)
        end = time.monotonic() + limit
        while True:
            while b"\n" in self._pending:
                line, self._pending = self._pending.split(b"\n", 1)
                answer = _parsed(line)
                if answer.get("id") == identity:
                    return answer
            ready, _, _ = select.select([self._channel], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                self.kill()
                return Outcome("timeout", f"the run took longer than {limit:g} s")
            try:
                data = self._channel.recv(65536)
            except ConnectionError:
                data = b""
            if not data:
                return Outcome("crashed", self._exit_outcome() + self._tail(start))
            self._pending += data

    def _exit_outcome(self) -> str:
        try:
            code = self._process.wait(MAX_EXIT_SECONDS)
        except subprocess.TimeoutExpired:
            self.kill()
            return "the process closed its connection to the sweep"
        return f"the process ended with signal {signal.Signals(-code).name}" if code < 0 else f"the process ended with code {code}"

    def _tail(self, start: int) -> str:
        """Returns the last line that was written to the log after an offset."""
        with open(self._log, "rb") as file:
            file.seek(max(start, os.path.getsize(self._log) - MAX_TAIL))
            printed = file.read().decode(errors="replace").strip()
        return ": " + printed.splitlines()[-1] if printed else ""


class Worker:
    """
    A worker runs the bundle's scenario repeatedly.

    It reuses a process only if neither scripts nor programs can keep state. Otherwise it starts the process of the next run while a run is executed. Only
    the method `kill` is thread-safe.
    """

    def __init__(self, bundle: str, log: str, trust: bool = False):
        self._bundle = bundle
        self._log = log
        self._trust = trust
        jars = glob.glob(os.path.join(glob.escape(bundle), "programs*.jar"))
        self._programs_keep_state = not jars or any(can_leave_state(jar) for jar in jars)
        self._idle: _Process | None = None
        self._busy: _Process | None = None
        self._closed = False

    def run(self, settings: dict[str, Any], process: str, out: str, limit: float, is_repeated: bool) -> Outcome:
        """
        Runs the scenario in a process that has started with the settings `process`, and returns the outcome.

        The run writes its outputs to `out`, which must be a new folder. `limit` is in seconds. With `is_repeated`, runs the scenario again in a fresh
        process, and both results must be equal.
        """
        outcome = self._run(settings, process, out, limit, fresh=False)
        if outcome.status != "complete" or not is_repeated:
            return outcome
        second = os.path.join(out, REPEATED)
        os.mkdir(second)
        again = self._run(settings, process, second, limit, fresh=True)
        if again.status != "complete":
            return Outcome(again.status, f"in the repetition: {again.message}")
        problem = _difference(_manifest(out), _manifest(second)) or _table_difference(out, second)
        shutil.rmtree(second)
        return Outcome("differs", problem) if problem else outcome

    def check(self, settings: dict[str, Any]) -> tuple[str | None, list[str]]:
        """Returns the error in a scenario's keys, or None if they are valid, and the scene's metrics."""
        process = self._idle = self._idle or self._start(None)
        answer = process.request({"check": True, "set": settings}, MAX_START_SECONDS)
        if isinstance(answer, Outcome):
            raise WorkerError(f"the player does not start: {answer.message}")
        return answer["problem"], answer["metrics"] or []

    def stop(self) -> None:
        """Ends all processes of the worker."""
        for process in (self._busy, self._idle):
            if process is not None:
                process.end()
        self._busy = self._idle = None

    def kill(self) -> None:
        """Cancels the current run and prevents further ones. Any thread may call this method."""
        self._closed = True
        process = self._busy
        if process is not None:
            process.kill()

    def _run(self, settings: dict[str, Any], start: str, out: str, limit: float, fresh: bool) -> Outcome:
        process, self._idle = self._idle, None
        warm: _Process | None = None
        if process is not None and process.settings != start:
            process.end()
            process = None
        elif process is not None and fresh and not process.is_fresh:
            process, warm = None, process
        self._busy = process = process or self._start(start)
        # A reused process was not busy during an earlier call of `kill`.
        if self._closed:
            process.kill()
        try:
            keeps_state = process.keeps_state()
            if isinstance(keeps_state, Outcome):
                return keeps_state
            if keeps_state or self._programs_keep_state:
                self._idle = self._start(start)
            process.is_fresh = False
            answer = process.request({"out": os.path.abspath(out), "set": settings}, limit)
            if isinstance(answer, Outcome):
                return answer
            if answer["again"] and self._idle is None:
                self._idle, self._busy = process, None
            if answer["code"] != 0:
                return Outcome("failed", _last_error(os.path.join(out, "log.txt")))
            outcome = _manifest(out).get("outcome")
            return Outcome("complete") if outcome == "complete" else Outcome("failed", f"the manifest's outcome is '{outcome}', not 'complete'")
        finally:
            if self._busy is not None:
                self._busy.end()
            self._busy = None
            # The JVM of this process has compiled the programs, so the next run is faster there than in a fresh process.
            if warm is not None:
                if self._idle is not None:
                    self._idle.end()
                self._idle = warm

    def _start(self, settings: str | None) -> _Process:
        process = _Process(self._bundle, self._log, self._trust, settings)
        if self._closed:
            process.kill()
        return process


def _parsed(line: bytes) -> dict[str, Any]:
    try:
        answer = json.loads(line)
    except ValueError:
        return {}
    return answer if isinstance(answer, dict) else {}


def _manifest(folder: str) -> dict[str, Any]:
    try:
        with open(os.path.join(folder, "manifest.json"), "rb") as file:
            return _parsed(file.read())
    except OSError:
        return {}


def _difference(first: dict[str, Any], second: dict[str, Any]) -> str:
    """Describes the first difference between the results of a run and its repetition. Returns an empty string if the results are equal."""
    if first.get("digest") != second.get("digest"):
        return f"the digest was {first.get('digest')}, but {second.get('digest')} when repeated in a fresh process"
    for key in ("ticks", "nodes", "errors", "start", "end", "converged"):
        if first.get(key) != second.get(key):
            return (f"'{key}' was {json.dumps(first.get(key))}, but {json.dumps(second.get(key))} when repeated in a fresh process "
                    f"(digest {first.get('digest')} in both)")
    return ""


def _table_difference(first: str, second: str) -> str:
    """Describes the first difference between the tables in two folders, except for times. Returns an empty string if the tables are equal."""
    for name in ("metrics.csv", "nodes.csv"):
        for number, (line, other) in enumerate(zip_longest(_lines(first, name), _lines(second, name), fillvalue=""), 1):
            if line != other:
                return f"line {number} of {name} was {line.strip()}, but {other.strip()} when repeated in a fresh process"
    return ""


def _lines(folder: str, name: str) -> Iterator[str]:
    """Yields the lines of a table without times, or none if it does not exist."""
    with contextlib.suppress(FileNotFoundError), open(os.path.join(folder, name), newline="\n", encoding="utf-8") as file:
        for line in file:
            yield line.rsplit(",", len(TIMES))[0] if name == "metrics.csv" else line


def java_home() -> str:
    """Returns the JDK or JRE that runs simulations, which is COLLEKTIVE_JAVA_HOME, JAVA_HOME or the newest one on this machine."""
    for name in ("COLLEKTIVE_JAVA_HOME", "JAVA_HOME"):
        if os.environ.get(name):
            return os.environ[name]
    best, best_version = "", 0
    folder = "/usr/lib/jvm"
    for entry in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
        home = os.path.join(folder, entry)
        if not os.path.exists(os.path.join(home, "lib/server/libjvm.so")) or not os.path.exists(os.path.join(home, "release")):
            continue
        with open(os.path.join(home, "release"), encoding="utf-8") as file:
            version = next((line.split('"')[1] for line in file if line.startswith("JAVA_VERSION=")), "0")
        if int(version.split(".")[0]) > best_version:
            best, best_version = home, int(version.split(".")[0])
    if best_version < 17:
        raise WorkerError("no JDK 17 or newer found: install one, or set COLLEKTIVE_JAVA_HOME")
    return os.path.realpath(best)


def _last_error(log: str) -> str:
    try:
        with open(log, encoding="utf-8", errors="replace") as file:
            lines = [line.strip() for line in file if line.strip()]
    except OSError:
        return ""
    errors = [line for line in lines if line.startswith("collektive: ")]
    return (errors or lines or [""])[-1].removeprefix("collektive: ")
