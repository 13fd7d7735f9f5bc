"""A process of the player that runs scenarios one after the other, with one JVM."""
import json
import os
import select
import signal
import subprocess
import time
from dataclasses import dataclass
from typing import Any

MARK = b"collektive-run "
MAX_TAIL = 4000


class WorkerError(Exception):
    """A worker could not be started at all."""


@dataclass(frozen=True)
class Outcome:
    """How a run ended."""
    status: str
    """`complete`; `failed`: it ended with an error; `crashed`: its process died; `timeout`: it took too long."""
    message: str = ""


class Worker:
    """
    Runs what the bundle has. One thread uses it. The process is started when it is needed, and again after a run that failed or
    left something behind; it ends by itself when this process is gone.
    """

    def __init__(self, bundle: str, log: str, trust: bool = False):
        self._bundle = bundle
        self._log = log
        self._trust = trust
        self._process: subprocess.Popen[bytes] | None = None
        self._pending = b""
        self._jvm: str | None = None
        self.closed = False

    def run(self, settings: dict[str, Any], jvm: str, out: str, limit: float) -> Outcome:
        """Runs the scenario into a new folder; `limit` in seconds."""
        if self._jvm != jvm:
            self.stop()
        self._jvm = jvm
        answer = self._ask({"out": os.path.abspath(out), "set": settings}, limit)
        if isinstance(answer, Outcome):
            self.stop()
            return answer
        if not answer["again"]:
            self.stop()
        return Outcome("complete") if answer["code"] == 0 else Outcome("failed", _last_error(os.path.join(out, "log.txt")))

    def check(self, settings: dict[str, Any]) -> tuple[str | None, list[str]]:
        """What is wrong with a scenario's keys, or None; and the scene's metrics."""
        answer = self._ask({"check": True, "set": settings}, 60)
        if isinstance(answer, Outcome):
            self.stop()
            raise WorkerError(f"the player does not start: {answer.message}")
        return answer["problem"], answer["metrics"] or []

    def stop(self) -> None:
        """Ends the process, if there is one."""
        process, self._process = self._process, None
        if process is None:
            return
        if process.stdin:
            try:
                process.stdin.close()
            except OSError:
                pass  # It is gone already.
        try:
            process.wait(2)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        if process.stdout:
            process.stdout.close()

    def kill(self) -> None:
        """Ends the process at once; may be called from another thread. No other is started."""
        self.closed = True
        process = self._process
        if process is not None:
            process.kill()

    def _ask(self, request: dict[str, Any], limit: float) -> dict[str, Any] | Outcome:
        process = self._process or self._start()
        assert process.stdin and process.stdout
        start = os.path.getsize(self._log)
        try:
            process.stdin.write(json.dumps(request).encode() + b"\n")
            process.stdin.flush()
        except OSError:
            pass  # It died; its output ends.
        end = time.monotonic() + limit
        while True:
            while b"\n" in self._pending:
                line, self._pending = self._pending.split(b"\n", 1)
                if line.startswith(MARK):
                    answer: dict[str, Any] = json.loads(line[len(MARK):])
                    return answer
            ready, _, _ = select.select([process.stdout], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                process.kill()
                return Outcome("timeout", f"the run took longer than {limit:g} s")
            data = os.read(process.stdout.fileno(), 65536)
            if not data:
                code = process.wait()
                name = f"signal {signal.Signals(-code).name}" if code < 0 else f"code {code}"
                return Outcome("crashed", f"the process ended with {name}{self._tail(start)}")
            self._pending += data

    def _start(self) -> subprocess.Popen[bytes]:
        bundle = os.path.abspath(self._bundle)
        native = os.path.join(bundle, "native")
        library_path = os.environ.get("LD_LIBRARY_PATH")
        with open(os.path.join(bundle, "inputs.json"), encoding="utf-8") as file:
            inputs = json.dumps(json.load(file)["hashes"])
        with open(self._log, "ab") as log:
            self._process = subprocess.Popen(
                ["mono-sgen", "--debug", os.path.join(bundle, "csharp/Collektive.Player.exe"), "serve", os.path.join(bundle, "inputs/scenario.json"),
                 "--scripts", os.path.join(bundle, "Scenario.dll"), "--jar", os.path.join(bundle, "programs.jar"),
                 "--host-jar", os.path.join(bundle, "jars/collektive-host.jar"), "--java-home", java_home(), "--inputs", inputs,
                 *(["--trust-jvm"] if self._trust else [])],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, cwd=os.path.dirname(self._log), start_new_session=True,
                env={**os.environ, "LD_LIBRARY_PATH": native + (":" + library_path if library_path else "")})
        self._pending = b""
        if self.closed:
            self._process.kill()
        return self._process

    def _tail(self, start: int) -> str:
        """What the process has printed since, in short."""
        with open(self._log, "rb") as file:
            file.seek(max(start, os.path.getsize(self._log) - MAX_TAIL))
            printed = file.read().decode(errors="replace").strip()
        return ": " + printed.splitlines()[-1] if printed else ""


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
