#!/usr/bin/env python3
"""Disturbs runs of a small scenario with signals, full disks, clock changes and little memory.

`chaos.py KILLS DISKS SIGNALS OTHERS FAULTS [--seed N] [--results FILE.xml]` runs the given number of trials of each kind. OTHERS is the number of trials
with clock changes and of trials with little memory. In each of the FAULTS trials, one call fails in a run that replaces earlier results. The script prints
a table of trials and outcomes, and "N passed, N failed".

After each trial, these conditions must hold:
- If the exit code is 0, all ticks are done.
- If the outcome in the manifest is "complete", the results are complete.
- No process is left.
- Earlier results in another folder are unchanged.
- Earlier results that the run replaces exist until the run has begun.

At the end, an undisturbed run must succeed.
"""
import argparse
import collections
import concurrent.futures
import glob
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(os.path.dirname(HERE)))
from build.places import BUILD, COLLEKTIVE, ROOT  # noqa: E402  (lies in a folder above)
from tests import junit  # noqa: E402

PROJECT = os.path.join(ROOT, "scripts/tests/acceptance/foreign")
SECONDS, TICKS = 20, 200
LIMIT_S = 240
# The time limit in seconds until all processes must have ended after a signal.
EXIT_LIMIT_S = 20
MARK = "COLLEKTIVE_CHAOS"
MOUNTED = 'mount -t tmpfs -o size="$SIZE" none "$DISK" || exit 99; eval "$FAULT"; "$@"; code=$?; cp -r "$DISK/out" "$KEEP" 2>/dev/null; exit $code'


@dataclass(frozen=True)
class Outcome:
    end: str
    """A description of how the run ended, for the table."""
    problems: list[str]


class Trial:
    """A trial, which disturbs a run in a separate folder."""

    def __init__(self, kind: str, number: int, count: int, seed: int, reference: dict[str, Any], duration: float) -> None:
        self.kind, self.number, self.count, self.reference, self.duration = kind, number, count, reference, duration
        self.mark = f"{os.getpid()}-{kind}-{number}"
        self.random = random.Random(f"{seed} {kind} {number}")
        self.folder = tempfile.mkdtemp(prefix="collektive-chaos-")
        self.detail = ""
        self.is_edited = self.random.random() < 0.2
        self.problems: list[str] = []

    def path(self, *parts: str) -> str:
        return os.path.join(self.folder, *parts)

    def run(self) -> Outcome:
        try:
            shutil.copytree(PROJECT, self.path("project"))
            write_scenario(self.path("project", "lamps.json"))
            if self.is_edited:
                # Because of this change, the run begins with a compilation, which the trial can disturb, too.
                with open(self.path("project", "scene", "Lamps.cs"), "a") as file:
                    file.write(f"// {self.mark}\n")
            shutil.copytree(self.reference["folder"], self.path("earlier"))
            code, output, out = getattr(self, self.kind)()
            problems = self.problems + self.wait_for_the_last() + broken(out, code, self.reference)
            if digest_of(self.path("earlier")) != self.reference["files"]:
                problems.append("earlier results have changed")
            if problems:
                problems.append(f"{self.detail}: code {code}: {output[-1500:]}")
            return Outcome(ending(code), problems)
        finally:
            shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, prefix: tuple[str, ...] = (), out: str = "out", words: tuple[str, ...] = (), **environment: str) -> subprocess.Popen[str]:
        command = [*prefix, str(COLLEKTIVE), "run", self.path("project", "lamps.json"), "--out", self.path(out), *words]
        return subprocess.Popen(command, cwd=self.folder, env={**os.environ, MARK: self.mark, **environment}, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")

    def end(self, process: subprocess.Popen[str]) -> tuple[int, str]:
        try:
            output = process.communicate(timeout=LIMIT_S)[0]
        except subprocess.TimeoutExpired:
            for pid in marked(self.mark):
                kill(pid, signal.SIGKILL)
            return -1, "it hangs: " + process.communicate()[0]
        return process.returncode, output

    def kill(self) -> tuple[int, str, str]:
        """Sends SIGKILL to the player, the command or all processes at a random time."""
        into_earlier = self.random.random() < 0.2
        process = self.start(out="earlier" if into_earlier else "out")
        target, moment = self.random.choice(["player", "command", "all"]), self.random.uniform(0, 1.05 * self.duration)
        self.detail = f"SIGKILL to {target} after {moment:.2f} s"
        time.sleep(moment)
        if target == "command":
            kill(process.pid, signal.SIGKILL)
        elif target == "player":
            for pid in marked(self.mark, "Collektive.Player.exe"):
                kill(pid, signal.SIGKILL)
        else:
            # Kills all processes, as the end of a container does. The loop is needed because a process may start another one just before it is killed.
            while pids := marked(self.mark):
                for pid in pids:
                    kill(pid, signal.SIGKILL)
        return (*self.end(process), self.path("refused" if into_earlier else "out"))

    def signal(self) -> tuple[int, str, str]:
        number, moment = self.random.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP]), self.random.uniform(0, 1.05 * self.duration)
        self.detail = f"{number.name} after {moment:.2f} s"
        process = self.start()
        time.sleep(moment)
        kill(process.pid, number)
        return (*self.end(process), self.path("out"))

    def disk(self) -> tuple[int, str, str]:
        """Writes the results to a disk that is small, that is read-only, or that becomes read-only during the run."""
        fault = self.random.choice(["small", "small", "read-only", "becomes read-only"])
        size = self.random.choice([4, 8, 16, 64, 200, 400, 600, 800, 1000, 1500]) if fault == "small" else 20000
        moment = self.random.uniform(0.5, 1) * self.duration
        action = {"small": ":", "read-only": 'mount -o remount,ro "$DISK"',
                  "becomes read-only": f'(sleep {moment:.2f}; mount -o remount,ro,force "$DISK" || mount -o remount,size=4k "$DISK") &'}[fault]
        self.detail = f"disk {fault}, {size} KB"
        os.makedirs(self.path("disk"))
        os.makedirs(self.path("keep"))
        process = self.start(("unshare", "--mount", "bash", "-c", MOUNTED, "bash"), "disk/out", SIZE=f"{size}k", DISK=self.path("disk"),
                             FAULT=action, KEEP=self.path("keep"))
        return (*self.end(process), self.path("keep", "out"))

    def clock(self) -> tuple[int, str, str]:
        """Changes the time of day during the run."""
        jump, moment = self.random.choice([-86400, -3600, -1, 3600, 400 * 86400]), self.random.uniform(0, self.duration)
        self.detail = f"the clock jumps by {jump} s after {moment:.2f} s"
        offset = self.path("offset")
        write_text(offset, "+0")
        # Without the last two settings, libfaketime would also change the monotonic clock, and waits would end too early.
        process = self.start(LD_PRELOAD=clock_library(), FAKETIME_TIMESTAMP_FILE=offset, FAKETIME_NO_CACHE="1", FAKETIME_DONT_FAKE_MONOTONIC="1",
                             FAKETIME_FORCE_MONOTONIC_FIX="0")
        time.sleep(moment)
        write_text(offset + ".part", f"{jump:+}")
        os.replace(offset + ".part", offset)
        return (*self.end(process), self.path("out"))

    def memory(self) -> tuple[int, str, str]:
        """Limits the address space to a random size, between too little for Mono and enough for the run."""
        kilobytes = self.random.choice([100, 300, 600, 1000, 1500, 2000, 3000, 5000]) * 1000
        self.detail = f"{kilobytes} KB of address space"
        return (*self.end(self.start(("bash", "-c", f'ulimit -v {kilobytes}; "$@"', "bash"))), self.path("out"))

    def fault(self) -> tuple[int, str, str]:
        """Lets one write, rename, deletion, sync or start of a process fail in a run that replaces earlier results."""
        at = self.random.randint(1, 1000) if self.is_edited else 1 + self.number * self.reference["calls"] // self.count
        self.detail = f"call {at} fails"
        shutil.copytree(self.reference["folder"], self.path("out"))
        process = self.start((), "out", ("--overwrite",), **failing(at, self.folder))
        code, output = self.end(process)
        if "Traceback" in output:
            self.problems.append("the output contains a traceback")
        kept = next((folder for folder in (self.path("out"), self.path("out", "earlier.part")) if os.path.exists(os.path.join(folder, "manifest.json"))), None)
        if kept is None:
            self.problems.append("the earlier results are lost")
        elif content(os.path.join(kept, "manifest.json")) == content(os.path.join(self.reference["folder"], "manifest.json")):
            found = {**digest_of(self.path("out")), **(digest_of(self.path("out", "earlier.part")) if os.path.isdir(self.path("out", "earlier.part")) else {})}
            if not self.reference["files"].items() <= found.items():
                self.problems.append("the earlier results are incomplete")
        return code, output, self.path("out")

    def wait_for_the_last(self) -> list[str]:
        end = time.monotonic() + EXIT_LIMIT_S
        while time.monotonic() < end:
            left = marked(self.mark)
            if not left:
                return []
            time.sleep(0.1)
        for pid in left:
            kill(pid, signal.SIGKILL)
        return [f"leftover processes: {'; '.join(left.values())}"]


def write_text(path: str, text: str) -> None:
    with open(path, "w") as file:
        file.write(text)


def write_scenario(path: str) -> None:
    with open(path) as file:
        scenario = json.load(file)
    scenario.update(seconds=SECONDS, outputs={"metrics": True, "replay": True, "record": True})
    write_text(path, json.dumps(scenario))


def kill(pid: int, number: int) -> None:
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def marked(mark: str, words: str = "") -> dict[int, str]:
    """Returns the command lines of a trial's processes that contain the words, by process id."""
    found = {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/environ", "rb") as file:
                if f"{MARK}={mark}\0".encode() not in file.read():
                    continue
            with open(f"/proc/{pid}/cmdline", "rb") as file:
                line = file.read().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if words in line:
            found[int(pid)] = line[:200]
    return found


def digest_of(folder: str) -> dict[str, str]:
    digests = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            digests[name] = hashlib.sha256(file.read()).hexdigest()
    return digests


def content(path: str) -> bytes:
    with open(path, "rb") as file:
        return file.read()


def broken(out: str, code: int, reference: dict[str, Any]) -> list[str]:
    """Returns the errors in the outputs of a run that has ended with an exit code."""
    path = os.path.join(out, "manifest.json")
    if not os.path.exists(path):
        return ["exit code 0 without a manifest"] if code == 0 else []
    try:
        manifest = json.loads(content(path))
    except ValueError:
        return ["the manifest is incomplete"]
    problems = []
    page = os.path.join(out, "replay.html")
    if os.path.exists(page) and not content(page).rstrip().endswith(b"</html>"):
        problems.append("the page is incomplete")
    if manifest["outcome"] != "complete":
        return [*problems, f"exit code 0, and the run is '{manifest['outcome']}'"] if code == 0 else problems
    rows = content(os.path.join(out, "metrics.csv")).splitlines() if os.path.exists(os.path.join(out, "metrics.csv")) else []
    record = os.path.join(out, "run.clkrec")
    for what, is_valid in [("digest", manifest.get("digest") == reference["digest"]), ("ticks", manifest.get("ticks") == TICKS),
                        ("rows of metrics", len(rows) == SECONDS + 2), ("page", os.path.exists(page)),
                        ("record", os.path.exists(record) and content(record)[-12:-8] == b"END ")]:
        if not is_valid:
            problems.append(f"complete, but without the expected {what}")
    return problems


def ending(code: int) -> str:
    if code == 0:
        return "done"
    return f"ended by {signal.Signals(code - 128).name}" if 128 < code < 160 else "killed" if code < 0 else "refused or failed"


def make_reference(work: str) -> tuple[dict[str, Any], float]:
    """Runs the scenario without a disturbance. Returns the results, and the duration without compilation."""
    shutil.copytree(PROJECT, os.path.join(work, "project"))
    scenario, out = os.path.join(work, "project", "lamps.json"), os.path.join(work, "out")
    write_scenario(scenario)
    for _ in range(2):
        began = time.monotonic()
        result = subprocess.run([COLLEKTIVE, "run", scenario, "--out", out, "--overwrite"], capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"collektive: chaos: the undisturbed run failed:\n{result.stderr}")
    duration = time.monotonic() - began
    subprocess.run([COLLEKTIVE, "run", scenario, "--out", out, "--overwrite"], check=True, capture_output=True, env={**os.environ, **failing(0, work)})
    calls = int.from_bytes(content(os.path.join(work, "calls")), sys.byteorder)
    digest = json.loads(content(os.path.join(out, "manifest.json")))["digest"]
    return {"folder": out, "files": digest_of(out), "digest": digest, "scenario": scenario, "calls": calls}, duration


def failing(at: int, folder: str) -> dict[str, str]:
    """Returns the environment variables for a command in which the call with the given number fails."""
    calls = os.path.join(folder, "calls")
    with open(calls, "wb") as file:
        file.write(bytes(8))
    return {"LD_PRELOAD": str(BUILD / "failing.so"), "FAILING_CALLS": calls, "FAILING_AT": str(at), "FAILING_BELOW": f"{folder}:{BUILD}"}


def clock_library() -> str:
    """Returns the path of libfaketime, or an empty string if it is not installed."""
    return next(iter(glob.glob("/usr/lib/*/faketime/libfaketime.so.1")), "")


def can_mount() -> bool:
    return subprocess.run(["unshare", "--mount", "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode == 0


def main() -> int:
    parser = argparse.ArgumentParser()
    for kind in ("kills", "disks", "signals", "others", "faults"):
        parser.add_argument(kind, type=int)
    parser.add_argument("--seed", type=int, default=int(time.strftime("%j")), help="(default: another one each day of the year)")
    parser.add_argument("--results")
    given = parser.parse_args()
    # A background job of a shell ignores SIGINT. Without this handler, child processes would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    counts = {"kill": given.kills, "disk": given.disks, "signal": given.signals, "clock": given.others, "memory": given.others, "fault": given.faults}
    if not can_mount():
        print("disk: skipped, mounting is not permitted")
        counts["disk"] = 0
    if not clock_library():
        print("clock: skipped, libfaketime is not installed")
        counts["clock"] = 0
    cases = []
    with tempfile.TemporaryDirectory(prefix="collektive-chaos-") as work, concurrent.futures.ThreadPoolExecutor(2) as pool:
        reference, duration = make_reference(work)
        print(f"an undisturbed run takes {duration:.1f} s; seed {given.seed}\n{'kind':8} {'trials':>6} {'failed':>6}  ends", flush=True)
        for kind, count in counts.items():
            trials = [Trial(kind, number, count, given.seed, reference, duration) for number in range(count)]
            outcomes = list(pool.map(Trial.run, trials))
            ends = collections.Counter(outcome.end for outcome in outcomes)
            failed = [outcome for outcome in outcomes if outcome.problems]
            print(f"{kind:8} {count:6} {len(failed):6}  {', '.join(f'{number} {end}' for end, number in ends.most_common())}", flush=True)
            for outcome in failed:
                print("  " + "\n    ".join("; ".join(outcome.problems).splitlines()), flush=True)
            cases += [junit.Case(f"{kind} {number}", "; ".join(outcome.problems)) for number, outcome in enumerate(outcomes)]
        after = subprocess.run([COLLEKTIVE, "run", reference["scenario"], "--out", reference["folder"], "--overwrite"], capture_output=True, text=True)
        cases.append(junit.Case("a final undisturbed run", "" if after.returncode == 0 else after.stderr or "failed"))
    return junit.report(given.results, "chaos", cases)


if __name__ == "__main__":
    sys.exit(main())
