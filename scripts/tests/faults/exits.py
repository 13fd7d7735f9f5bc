#!/usr/bin/env python3
"""Ends runs repeatedly in different ways. Checks the exit code, that the JVM shuts down cleanly, and the flight recording.

`exits.py RUNS [KIND]... [--results FILE.xml]` tests the given kinds, or all of them, in both placements on every runtime and JVM. With --results, it writes
the results as JUnit XML. The last line of its output is "N passed, N failed".
"""
import argparse
import collections
import concurrent.futures
import json
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
from typing import Any

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
from build import managed
from tests import junit
from tests.faults import places as files

# The ways in which a run ends, and the exit code of each.
KINDS = {"leave": 0, "quit": 3, "ctrl-c": 130, "termination": 143, "exception": 1, "thread-exception": 1}
# Exit codes that are different on CoreCLR, which aborts the process.
CORECLR_CODES = {"thread-exception": -signal.SIGABRT}
SIGNALS = {"ctrl-c": signal.SIGINT, "termination": signal.SIGTERM}
LIMIT_S = 180
PLACEMENTS = ["InProcess", "OwnProcess"]


def command(places: dict[str, Any], kind: str, runtime: str, jdk: str, placement: str, folder: str) -> list[str]:
    """Returns the command line of the player. On CoreCLR, returns that of a program which runs the same scene."""
    flag = "-XX:StartFlightRecording=filename=" + os.path.join(folder, "record.jfr")
    if runtime == "coreclr":
        return [runtime, "--debug", places["program"], "act=exit", "how=" + kind, "placement=" + placement, "home=" + jdk,
                "host=" + places["host"], "jar=" + places["jar"],
                "option=-Xmx128m", "option=-XX:+UseSerialGC", "option=" + flag]
    path = os.path.join(folder, "exits.json")
    with open(path, "w") as file:
        json.dump(scenario(places, folder, 1000 if kind in SIGNALS else 2, placement, flag), file)
    return [runtime, "--debug", places["player"], "run", path, "--scripts", places["program"], "--jar", places["jar"], "--host-jar",
            places["host"], "--java-home", jdk, "--out", os.path.join(folder, "out"), "--set", "how=" + kind, "--trust-jvm"]


def scenario(places: dict[str, Any], folder: str, seconds: int, placement: str, flag: str) -> dict[str, Any]:
    return {"version": 1, "scene": "Collektive.Headless.Faults.Ending", "scripts": folder, "schema": places["schema"],
            "programs": places["jar"], "program": "fault", "seconds": seconds, "threads": 2,
            "jvm": {"placement": placement, "maximumHeapMb": 128, "collector": "Serial", "flags": [flag]},
            "outputs": {"metrics": True}}


def recording_problem(path: str) -> str:
    """Returns the error in a flight recording, or an empty string. A chunk without a length in its header is unfinished."""
    if not os.path.exists(path):
        return "the flight recording is missing"
    with open(path, "rb") as file:
        data = file.read()
    at = 0
    while at < len(data):
        if data[at:at + 4] != b"FLR\0" or at + 16 > len(data):
            return f"the flight recording is damaged at byte {at}"
        length, = struct.unpack_from(">q", data, at + 8)
        if length <= 0 or at + length > len(data):
            return f"the flight recording's chunk at byte {at} has no end"
        at += length
    return "" if data else "the flight recording is empty"


def run(places: dict[str, Any], kind: str, index: int) -> str:
    """Runs a scene until it ends in the given way. Returns the error, or an empty string."""
    placement = PLACEMENTS[index % 2]
    index //= 2
    runtime = places["runtimes"][index % len(places["runtimes"])]
    jdk = places["jdks"][index // len(places["runtimes"]) % len(places["jdks"])]
    folder = tempfile.mkdtemp(prefix="collektive-exit-")
    try:
        environment = managed.environment(runtime)
        words = command(places, kind, runtime, jdk, placement, folder)
        process = subprocess.Popen(words, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        watchdog = threading.Timer(LIMIT_S, process.kill)
        watchdog.start()
        text = b""
        assert process.stdout
        for line in process.stdout:
            text += line
            if kind in SIGNALS and b"ten ticks done" in line:
                time.sleep(random.random() * 0.2)
                process.send_signal(SIGNALS[kind])
        code = process.wait()
        watchdog.cancel()
        problems = []
        expected = CORECLR_CODES.get(kind, KINDS[kind]) if runtime == "coreclr" else KINDS[kind]
        if code != expected:
            problems.append(f"exit code {code} instead of {expected}")
        if b"did not end" in text:
            problems.append("the JVM did not shut down cleanly")
        problem = recording_problem(os.path.join(folder, "record.jfr"))
        if problem:
            problems.append(problem)
        if index < 2 and not problem:
            summary = subprocess.run([os.path.join(jdk, "bin/jfr"), "summary", os.path.join(folder, "record.jfr")], capture_output=True, text=True)
            if summary.returncode != 0 or "jdk.JVMInformation" not in summary.stdout:
                problems.append("jfr summary cannot read the flight recording")
        if not problems:
            return ""
        where = f"{kind} on {runtime}, {os.path.basename(jdk)}, {placement}"
        return f"{where}: {'; '.join(problems)}\n    " + text.decode(errors="replace")[-2000:].replace("\n", "\n    ")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("runs", type=int)
    parser.add_argument("kinds", nargs="*", default=list(KINDS))
    parser.add_argument("--results")
    arguments = parser.parse_args()
    runs, kinds = arguments.runs, arguments.kinds
    places = files.all_runtimes()
    # A background job of a shell ignores SIGINT. Without this handler, child processes would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    cases = []
    with concurrent.futures.ThreadPoolExecutor(places["jobs"]) as pool:
        rows = {kind: [pool.submit(run, places, kind, index) for index in range(runs)] for kind in kinds}
        for kind, futures in rows.items():
            outcomes = [future.result() for future in futures]
            cases += [junit.Case(f"{kind}, run {index}", problem) for index, problem in enumerate(outcomes)]
            problems = [problem for problem in outcomes if problem]
            print(f"{kind:17} {runs - len(problems):4} of {runs} runs passed", flush=True)
            for problem, count in collections.Counter(problems).most_common(5):
                print(f"  {count} times: {problem}")
    sys.exit(junit.report(arguments.results, "exits", cases))


if __name__ == "__main__":
    main()
