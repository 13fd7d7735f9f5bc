#!/usr/bin/env python3
"""./collektive test: runs suites and adds up the results that they write.

A suite is a step of scripts/test.sh. It gets an empty folder, build/results/NAME, writes its results there as JUnit XML, and ends with a code
other than 0 when a test failed. One that writes no results, or ends badly though no test failed, counts as a failure. What it writes to the file
`notes` of that folder, such as what it could not run and why, is shown; with notes it may have run no test.
"""
import functools
import glob
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field

import junit
from places import BUILD, COLLEKTIVE

STARTED = float(os.environ.get("COLLEKTIVE_STARTED") or time.time())


@dataclass(frozen=True)
class Suite:
    name: str
    """What the user calls it; several suites may share a name."""
    step: list[str]
    """A function of scripts/test.sh and its arguments after the folder for results."""
    needs: list[str] = field(default_factory=list)
    """Functions that build what it needs, in order."""
    quick: bool = False
    """Whether it belongs to `--quick`."""
    nunit: bool = False
    """Whether it needs NUnit, which some systems have no package of: there it is left out."""
    label: str = ""
    """Its name in the output and in build/results, where it differs."""

    @property
    def title(self) -> str:
        return self.label or self.name


def all_suites(jdks: list[str]) -> list[Suite]:
    """All suites in their order. The JVM side comes first: its tests build what the others use."""
    built = ["build_all"]
    nunit = ["setup_nunit", *built, "build_csharp_tests"]
    newest = jdks[-1:]
    return [
        Suite("lint", ["test_lint"], ["setup_python", "setup_npm", "setup_ktlint", "setup_actionlint"], quick=True),
        Suite("scripts", ["test_scripts"], ["setup_python", "setup_flatbuffers", "setup_physx"], quick=True),
        Suite("jvm", ["test_jvm"], ["setup_flatc"], quick=True),
        Suite("stress", ["test_stress"], ["build_jvm"]),
        *(Suite("shim", ["test_shim", jdk], ["build_native"], [jdk] == newest, label="shim-on-" + os.path.basename(jdk)) for jdk in jdks),
        Suite("platforms", ["test_platforms"], [*built, "setup_python"]),
        Suite("csharp", ["test_unity"], nunit, quick=True, nunit=True, label="unity"),
        *(Suite("csharp", ["test_csharp", jdk], nunit, [jdk] == newest, True, "csharp-on-" + os.path.basename(jdk)) for jdk in jdks),
        *(Suite("csharp", ["test_csharp", jdk, "coreclr"], nunit, nunit=True, label="csharp-on-coreclr") for jdk in newest),
        Suite("assets", ["test_assets"], [*built, "setup_python"], quick=True),
        Suite("faults", ["test_faults"], nunit, nunit=True),
        Suite("exits", ["test_exits"], nunit, nunit=True),
        Suite("soak", ["test_soak"], [*nunit, "build_soak"], nunit=True),
        Suite("roundtrip", ["test_roundtrip"], [*built, "setup_python"]),
        Suite("page", ["test_page"], [*built, "build_replay_page"]),
        Suite("site", ["test_site"], [*built, "setup_npm", "setup_site"]),
        Suite("acceptance", ["test_acceptance"], [*built, "build_replay_page", "setup_python"]),
        Suite("quick", ["test_acceptance_quick"], [*built, "build_replay_page", "setup_python"], quick=True, label="acceptance-quick"),
        Suite("experiments", ["test_experiments"], [*built, "setup_experiments_tests"]),
        Suite("chaos", ["test_chaos"], [*built, "build_replay_page"]),
        Suite("fuzz", ["test_fuzz"], ["build_csharp", "build_fuzz"]),
        Suite("bench", ["test_bench"], [*built, "setup_python"]),
        Suite("gradle", ["test_gradle"], ["build_jvm", "setup_python"]),
    ]


def chosen(suites: list[Suite], names: list[str]) -> list[Suite]:
    """The suites with these names: all without a name, those of a short run with `--quick`. Raises ValueError for an unknown name."""
    if names == ["--quick"]:
        return [suite for suite in suites if suite.quick]
    known = list(dict.fromkeys(suite.name for suite in suites if suite.name != "quick"))
    for name in names:
        if name not in known:
            raise ValueError(f"unknown suite '{name}'; known: {' '.join(known)}")
    return [suite for suite in suites if suite.name in (names or known)]


def check_names(names: list[str]) -> None:
    """Raises ValueError for an unknown name. Needs no JDKs, so it comes before anything is installed."""
    chosen(all_suites(["any"]), names)


def say(text: str) -> None:
    print(f"[{time.time() - STARTED:4.0f}s] {text}", file=sys.stderr, flush=True)


def step(*words: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run([COLLEKTIVE, "step", *words], **options)


@functools.cache
def has_nunit() -> bool:
    step("setup_nunit")
    return step("has_nunit").returncode == 0


def results(folder: str, code: int) -> list[junit.Case]:
    """The tests that a suite has run, by the files in its folder and the code that it ended with."""
    cases, broken = [], []
    paths = sorted(glob.glob(os.path.join(glob.escape(folder), "*.xml")))
    for path in paths:
        try:
            cases += junit.read(path)
        except ValueError as error:
            broken.append(junit.Case(os.path.basename(path), str(error)))
    if not broken and not cases and not (code == 0 and notes(folder)):
        broken.append(junit.Case("results", f"the suite wrote no results and ended with code {code}"))
    if not broken and code != 0 and not any(case.failure for case in cases):
        broken.append(junit.Case("end", f"the suite ended with code {code} though no test failed"))
    return cases + broken


def notes(folder: str) -> str:
    path = os.path.join(folder, "notes")
    if not os.path.exists(path):
        return ""
    with open(path) as file:
        return file.read()


def run(suite: Suite, build: str) -> list[junit.Case]:
    folder, log = os.path.join(build, "results", suite.title), os.path.join(build, "log", f"test-{suite.title}.log")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.makedirs(os.path.dirname(log), exist_ok=True)
    say(f"test {suite.title} ...")
    with open(log, "w") as file:
        code = step(suite.step[0], folder, *suite.step[1:], stdout=file, stderr=subprocess.STDOUT).returncode
    cases = results(folder, code)
    failed = [case for case in cases if case.failure]
    if failed:
        with open(log, errors="replace") as file:
            sys.stderr.write("".join(file.readlines()[-60:]))
        for case in failed:
            print(f"FAILED {suite.title}: {case.name}: {case.failure.splitlines()[0][:200]}", file=sys.stderr)
    sys.stderr.write(notes(folder))
    say(f"test {suite.title}: {len(cases) - len(failed)} passed, {len(failed)} failed")
    return cases


def verdict(cases: list[junit.Case], skipped: str = "") -> int:
    failed = sum(bool(case.failure) for case in cases)
    print(f"{len(cases) - failed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed else 0


def main(names: list[str]) -> int:
    if names[:1] == ["sum"]:
        return verdict(results(names[1], int(names[2])), *names[3:])
    try:
        check_names(names)
    except ValueError as error:
        print(f"collektive: test: {error}", file=sys.stderr)
        return 1
    if step("setup_system").returncode != 0:
        return 1
    jdks = step("test_jdks", stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    suites = chosen(all_suites(jdks), names)
    if names == ["--quick"]:
        # The steps then leave out the tests that are marked slow.
        os.environ["COLLEKTIVE_QUICK"] = "1"
    if not names:
        # What takes long for the little that it adds waits until its suite is named.
        os.environ["COLLEKTIVE_ALL"] = "1"
    ready: set[str] = set()
    cases: list[junit.Case] = []
    for suite in suites:
        if suite.name == "gradle" and not shutil.which(os.environ.get("COLLEKTIVE_GRADLE", "gradle")):
            say("test gradle: skipped, there is no Gradle on the PATH, nor one that COLLEKTIVE_GRADLE names")
            continue
        if suite.nunit and suite.name not in names and not has_nunit():
            say(f"test {suite.title}: skipped, this system has no package of NUnit 2.6")
            continue
        for need in suite.needs:
            if need not in ready and step(need).returncode != 0:
                return 1
            ready.add(need)
        cases += run(suite, BUILD)
    return verdict(cases)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
