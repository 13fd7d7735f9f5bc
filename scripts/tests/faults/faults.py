#!/usr/bin/env python3
"""Causes each fault of faults.json in a separate process, and prints a table and "N passed, N failed".

`faults.py [--all] [WORDS]... [--results FILE.xml]` runs the faults whose names contain WORDS, or all of them. With --all, it runs them on every runtime and
JVM and in each placement of the JVM. Otherwise it runs them only on Mono with the newest JVM, in the first placement that the fault allows. The table has a
column for each combination. With --results, the script also writes the results as JUnit XML.
"""
import argparse
import concurrent.futures
import itertools
import json
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(os.path.dirname(HERE)))
from build import managed  # noqa: E402  (lie in a folder above)
from tests import junit  # noqa: E402
from tests.faults import places as files  # noqa: E402

LIMIT_S = 180
PLACEMENTS = ["InProcess", "OwnProcess"]
ORDER = ["next tick", "next session", "next start", "restart"]


class Trial:
    """A trial of a fault, whose files are in a separate folder."""

    def __init__(self, fault: dict[str, Any], places: dict[str, Any], runtime: str, jdk: str, placement: str, folder: str) -> None:
        self.fault, self.places, self.runtime, self.jdk, self.folder = fault, places, runtime, jdk, folder
        self.own = placement == "OwnProcess"
        if self.own:
            # In this placement, a new process replaces a JVM that was lost, so a restart is not needed.
            self.fault = {**fault, "works": "next start" if fault["works"] == "restart" else fault["works"], **fault.get("own", {})}

    def path(self, *parts: str) -> str:
        return os.path.join(self.folder, *parts)

    def cut(self, source: str, name: str) -> str:
        with open(source, "rb") as file:
            data = file.read()
        with open(self.path(name), "wb") as file:
            file.write(data[:len(data) // 2])
        return self.path(name)

    def home(self, kind: str) -> str:
        """Creates a JVM in which one file is missing or invalid, and returns its folder. The other files are links or copies."""
        if kind == "missing":
            return "/nowhere/jvm"
        home = self.path("home")
        damaged = {"no-libjvm": "lib/server/libjvm.so", "cut-libjvm": "lib/server/libjvm.so", "no-modules": "lib/modules",
                   "cut-modules": "lib/modules", "old": "release"}[kind]
        # The files java, libjli.so and libjvm.so are copied, because programs find their JVM by the resolved path of these files.
        for where, folders, names in os.walk(self.jdk):
            inside = os.path.relpath(where, self.jdk)
            if inside.split(os.sep)[0] in ("jmods", "include", "man", "demo", "legal", "docs"):
                folders[:] = []
                continue
            os.makedirs(os.path.join(home, inside), exist_ok=True)
            for name in names:
                relative = os.path.normpath(os.path.join(inside, name))
                if relative == damaged or name.endswith((".jsa", ".zip", ".debuginfo")):
                    continue
                real = os.path.realpath(os.path.join(where, name))
                target = os.path.join(home, relative)
                if name == "java" or name == "libjli.so" or name == "libjvm.so":
                    shutil.copy(real, target)
                else:
                    os.symlink(real, target)
        if kind.startswith("cut"):
            shutil.copy(self.cut(os.path.join(self.jdk, damaged), "half"), os.path.join(home, damaged))
        if kind == "old":
            with open(os.path.join(home, "release"), "w") as file:
                file.write('JAVA_VERSION="11.0.2"\n')
        return home

    def host(self, kind: str) -> str:
        if kind == "cut":
            return self.cut(self.places["host"], "host.jar")
        return {"missing": self.path("host.jar"), "incompatible": str(self.places["incompatible"])}[kind]

    def jar(self, kind: str) -> str:
        if kind == "missing":
            return self.path("programs.jar")
        if kind == "cut":
            return self.cut(self.places["jar"], "programs.jar")
        if kind == "other-schema":
            return str(self.places["incompatible"])
        with open(self.path("programs.jar"), "wb") as file:
            if kind == "newer":
                with zipfile.ZipFile(file, "w") as copy, zipfile.ZipFile(self.places["jar"]) as real:
                    for name in real.namelist():
                        data = real.read(name)
                        copy.writestr(name, data[:6] + struct.pack(">H", 99) + data[8:] if name.endswith(".class") else data)
        return self.path("programs.jar")

    def command(self) -> list[str]:
        fault = self.fault
        words = [self.runtime, "--debug", self.places["program"], "home=" + self.jdk, "host=" + self.places["host"], "jar=" + self.places["jar"]]
        words += [f"bad-{what}=" + getattr(self, what)(fault[what]) for what in ("home", "host", "jar") if what in fault]
        # Faults that end a session are endless ticks, which last until the step limit. The limit is therefore short for them.
        words += ["limit=" + str(fault.get("limit", 1500 if fault["works"] == "next session" else 30000))]
        words += ["placement=OwnProcess"] if self.own else []
        words += ["fault=" + fault.get("program", "none"), "act=" + fault.get("act", "none")]
        return words + ["option=" + option for option in fault.get("options", [])]

    def limit_files(self) -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (self.fault["file_limit"],) * 2)

    def run(self) -> tuple[str, str, str]:
        """Runs the trial. Returns the failure or an empty string, the line that the user reads, and the whole output."""
        environment = {**managed.environment(self.runtime), **self.fault.get("environment", {})}
        try:
            result = subprocess.run(self.command(), cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                    preexec_fn=self.limit_files if "file_limit" in self.fault else None, timeout=LIMIT_S)
        except subprocess.TimeoutExpired as expired:
            return "hangs", "", (expired.stdout or b"").decode(errors="replace")
        text = result.stdout.decode(errors="replace")
        read = next((line for line in text.splitlines() if re.search(self.fault.get("reads", "^$"), line)), "")
        works = re.findall(r"^still works: (.*), JVM (\w+)$", text, re.M)
        if result.returncode != 0 or not works:
            return f"ends with code {result.returncode}", read, text
        last, state = works[0]
        best = next((step for step in ORDER if step in last), "restart")
        problems = []
        if best != self.fault["works"]:
            problems.append(f"works afterwards: {last}")
        if "reads" in self.fault and not read:
            problems.append("the expected message was not printed")
        if best == "next tick" and "next play" not in last:
            problems.append("the next play did not start")
        if not last.endswith("C#"):
            problems.append("C# did not run after the fault")
        if state != ("Stopped" if best != "restart" else "None" if self.own else "Lost"):
            problems.append(f"the JVM is {state} at the end")
        return "; ".join(problems), read, text


def attempt(places: dict[str, Any], fault: dict[str, Any], runtime: str, jdk: str, placement: str) -> tuple[str, str, str]:
    folder = tempfile.mkdtemp(prefix="collektive-fault-")
    try:
        return Trial(fault, places, runtime, jdk, placement, folder).run()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def short(text: str, width: int) -> str:
    return text if len(text) <= width else text[:width - 3] + "..."


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("words", nargs="*")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--results")
    arguments = parser.parse_args()
    words = " ".join(arguments.words)
    places = files.all_runtimes() if arguments.all else files.newest_jdk()
    with open(os.path.join(HERE, "faults.json")) as file:
        faults = json.load(file)
    faults = [fault for fault in faults if words in fault["fault"]]
    if not faults:
        sys.stderr.write(f"collektive: no fault in faults.json has a name that contains '{words}'\n")
        sys.exit(2)
    kinds = [(*kind, placement) for placement in PLACEMENTS for kind in itertools.product(places["runtimes"], places["jdks"])]
    print("Columns: " + ", ".join(f"{index + 1} = {runtime} with {os.path.basename(jdk)}, {placement}"
                                  for index, (runtime, jdk, placement) in enumerate(kinds)) +
          '. "ok": the process survived and behaved as listed.\n')
    head = f"{'fault':52} " + " ".join(f"{index + 1:>2}" for index in range(len(kinds))) + f" {'works afterwards':16}  message"
    print(head + "\n" + "-" * len(head))
    cases = []
    with concurrent.futures.ThreadPoolExecutor(places["jobs"]) as pool:
        rows = []
        for fault in faults:
            placements = fault.get("placements", PLACEMENTS)[:None if arguments.all else 1]
            rows.append((fault, {kind: pool.submit(attempt, places, fault, *kind) for kind in kinds if kind[2] in placements}))
        for fault, futures in rows:
            results = [future.result() for future in futures.values()]
            marks = " ".join("--" if kind not in futures else " !" if futures[kind].result()[0] else "ok" for kind in kinds)
            read = next((read for _, read, _ in results if read), "")
            print(f"{short(fault['fault'], 52):52} {marks} {fault['works']:16}  {short(read, 150)}", flush=True)
            for (failure, _, text), (runtime, jdk, placement) in zip(results, futures):
                cases.append(junit.Case(f"{fault['fault']} on {runtime}, {os.path.basename(jdk)}, {placement}", failure))
                if failure:
                    lines = [short(line, 300) for line in text.splitlines()]
                    lines = lines[:15] + ["..."] + lines[15:][-15:]
                    print(f"    ! {runtime}, {os.path.basename(jdk)}, {placement}: {failure}\n        " + "\n        ".join(lines))
    sys.exit(junit.report(arguments.results, "faults", cases))


if __name__ == "__main__":
    main()
