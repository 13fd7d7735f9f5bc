"""Processes of the player, which run scenarios."""
import json
import os
import secrets
import select
import shutil
import signal
import socket
import subprocess
import time
from dataclasses import dataclass
from typing import Any

from . import files
from .programs import leave_state

MAX_TAIL = 4000
MAX_START_SECONDS = 120.0
"""Until a process accepts runs."""
MAX_EXIT_SECONDS = 2.0
REPEATED = "repeated"
"""Folder of a repetition, in that of the run until both are compared."""


class WorkerError(Exception):
    """A worker could not be started at all."""


@dataclass(frozen=True)
class Outcome:
    """How a run ended."""
    status: str
    """`complete`; `failed`: it ended with an error; `crashed`: its process died; `timeout`: it took too long; `differs`: a repetition gave another result."""
    message: str = ""


class _Process:
    """
    A process of the player, with the JVM for its runs, unless it only checks keys. Requests and answers go through a socket that no child of the process
    inherits; what the process prints goes to a log. It ends when the socket is closed.
    """

    def __init__(self, bundle: str, log: str, trust: bool, jvm: str | None):
        self.jvm = jvm
        self.is_fresh = True
        self._log = log
        self._pending = b""
        self._keeps_state: bool | None = None
        bundle = os.path.abspath(bundle)
        library_path = os.environ.get("LD_LIBRARY_PATH")
        with open(os.path.join(bundle, "inputs.json"), encoding="utf-8") as file:
            inputs = json.dumps(json.load(file)["hashes"])
        self._channel, theirs = socket.socketpair()
        with theirs, files.open_log(log) as output:
            self._process = subprocess.Popen(
                ["mono-sgen", "--debug", os.path.join(bundle, "csharp/Collektive.Player.exe"), "serve", os.path.join(bundle, "inputs/scenario.json"),
                 "--scripts", os.path.join(bundle, "Scenario.dll"), "--jar", os.path.join(bundle, "programs.jar"),
                 "--host-jar", os.path.join(bundle, "jars/collektive-host.jar"), "--java-home", java_home(), "--channel", str(theirs.fileno()),
                 "--inputs", inputs, *(["--trust-jvm"] if trust else [])],
                stdin=subprocess.DEVNULL, stdout=output, stderr=output, cwd=os.path.dirname(log), start_new_session=True, pass_fds=[theirs.fileno()],
                env={**os.environ, "LD_LIBRARY_PATH": os.path.join(bundle, "native") + (":" + library_path if library_path else "")})
        self._ready = "" if jvm is None else self._send({"start": True, "set": json.loads(jvm)})

    def keeps_state(self) -> bool | Outcome:
        """Waits until the process accepts runs; returns whether its scripts could leave something behind."""
        if self._keeps_state is None:
            answer = self._receive(self._ready, MAX_START_SECONDS)
            if isinstance(answer, Outcome):
                return answer
            self._keeps_state = answer["keepsState"] is not None
        return self._keeps_state

    def ask(self, request: dict[str, Any], limit: float) -> dict[str, Any] | Outcome:
        """Returns the answer to a request, or how the process ended instead."""
        return self._receive(self._send(request), limit)

    def kill(self) -> None:
        """Ends the process and its children; may be called from another thread."""
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def end(self) -> None:
        """Ends the process, and waits for that."""
        self._channel.close()
        self.kill()
        self._process.wait()

    def _send(self, request: dict[str, Any]) -> str:
        """Sends a request; returns its id, which a script cannot guess."""
        identity = secrets.token_hex(8)
        try:
            self._channel.sendall(json.dumps({"id": identity, **request}).encode() + b"\n")
        except OSError:
            pass  # The process died; its answers end.
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
                return Outcome("crashed", self._death() + self._tail(start))
            self._pending += data

    def _death(self) -> str:
        try:
            code = self._process.wait(MAX_EXIT_SECONDS)
        except subprocess.TimeoutExpired:
            self.kill()
            return "the process closed its connection to the sweep"
        return f"the process ended with signal {signal.Signals(-code).name}" if code < 0 else f"the process ended with code {code}"

    def _tail(self, start: int) -> str:
        """Returns the last line that the process printed since then."""
        with open(self._log, "rb") as file:
            file.seek(max(start, os.path.getsize(self._log) - MAX_TAIL))
            printed = file.read().decode(errors="replace").strip()
        return ": " + printed.splitlines()[-1] if printed else ""


class Worker:
    """
    Runs the bundle's scenario, one run after the other. A process is used again only if neither scripts nor programs can leave something
    behind; otherwise the process of the next run starts during a run. One thread uses a worker.
    """

    def __init__(self, bundle: str, log: str, trust: bool = False):
        self._bundle = bundle
        self._log = log
        self._trust = trust
        self._programs_keep_state = leave_state(os.path.join(bundle, "programs.jar"))
        self._idle: _Process | None = None
        self._busy: _Process | None = None
        self._closed = False

    def run(self, settings: dict[str, Any], jvm: str, out: str, limit: float, is_repeated: bool) -> Outcome:
        """
        Runs the scenario into a new folder; `limit` in seconds. A run that is repeated runs a second time in a process of its own, and the
        results of both must be equal.
        """
        outcome = self._run(settings, jvm, out, limit, fresh=False)
        if outcome.status != "complete" or not is_repeated:
            return outcome
        second = os.path.join(out, REPEATED)
        os.mkdir(second)
        again = self._run(settings, jvm, second, limit, fresh=True)
        if again.status != "complete":
            return Outcome(again.status, f"in the repetition: {again.message}")
        problem = _difference(_manifest(out), _manifest(second))
        shutil.rmtree(second)
        return Outcome("differs", problem) if problem else outcome

    def check(self, settings: dict[str, Any]) -> tuple[str | None, list[str]]:
        """Returns what is wrong with a scenario's keys, or None; and the scene's metrics."""
        process = self._idle = self._idle or self._start(None)
        answer = process.ask({"check": True, "set": settings}, MAX_START_SECONDS)
        if isinstance(answer, Outcome):
            raise WorkerError(f"the player does not start: {answer.message}")
        return answer["problem"], answer["metrics"] or []

    def stop(self) -> None:
        """Ends the processes, if there are any."""
        for process in (self._busy, self._idle):
            if process is not None:
                process.end()
        self._busy = self._idle = None

    def kill(self) -> None:
        """Ends the run at once, and starts no other; may be called from another thread."""
        self._closed = True
        process = self._busy
        if process is not None:
            process.kill()

    def _run(self, settings: dict[str, Any], jvm: str, out: str, limit: float, fresh: bool) -> Outcome:
        process, self._idle = self._idle, None
        if process is not None and (process.jvm != jvm or (fresh and not process.is_fresh)):
            process.end()
            process = None
        self._busy = process = process or self._start(jvm)
        try:
            keeps_state = process.keeps_state()
            if isinstance(keeps_state, Outcome):
                return keeps_state
            if keeps_state or self._programs_keep_state:
                self._idle = self._start(jvm)
            process.is_fresh = False
            answer = process.ask({"out": os.path.abspath(out), "set": settings}, limit)
            if isinstance(answer, Outcome):
                return answer
            if answer["again"] and self._idle is None:
                self._idle, self._busy = process, None
            if answer["code"] != 0:
                return Outcome("failed", _last_error(os.path.join(out, "log.txt")))
            outcome = _manifest(out).get("outcome")
            return Outcome("complete") if outcome == "complete" else Outcome("failed", f"its manifest is not complete: {outcome}")
        finally:
            if self._busy is not None:
                self._busy.end()
            self._busy = None

    def _start(self, jvm: str | None) -> _Process:
        process = _Process(self._bundle, self._log, self._trust, jvm)
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
    """Returns how the results of a run and of its repetition differ, or nothing."""
    if first.get("digest") != second.get("digest"):
        return f"its digest was {first.get('digest')}, and {second.get('digest')} when it was repeated in a process of its own"
    for key in ("ticks", "nodes", "errors", "end", "converged"):
        if first.get(key) != second.get(key):
            return (f"'{key}' was {json.dumps(first.get(key))}, and {json.dumps(second.get(key))} when it was repeated in a process of its own "
                    f"(digest {first.get('digest')} in both)")
    return ""


def java_home() -> str:
    """The JDK or JRE that runs simulations: COLLEKTIVE_JAVA_HOME, JAVA_HOME, or the newest of this machine."""
    for name in ("COLLEKTIVE_JAVA_HOME", "JAVA_HOME"):
        if os.environ.get(name):
            return os.environ[name]
    best, best_version = "", 0
    folder = "/usr/lib/jvm"
    for entry in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
        home = os.path.join(folder, entry)
        if not os.path.exists(os.path.join(home, "lib/server/libjvm.so")) or not os.path.exists(os.path.join(home, "release")):
            continue
        with open(os.path.join(home, "release")) as file:
            version = next((line.split('"')[1] for line in file if line.startswith("JAVA_VERSION=")), "0")
        if int(version.split(".")[0]) > best_version:
            best, best_version = home, int(version.split(".")[0])
    if best_version < 17:
        raise WorkerError("no JDK 17 or newer found: install one, or set COLLEKTIVE_JAVA_HOME")
    return os.path.realpath(best)


def _last_error(log: str) -> str:
    try:
        with open(log, errors="replace") as file:
            lines = [line.strip() for line in file if line.strip()]
    except OSError:
        return ""
    errors = [line for line in lines if line.startswith("collektive: ")]
    return (errors or lines or [""])[-1].removeprefix("collektive: ")
