"""Builds everything and runs all test suites, or the named ones. Areas of suites: lint, scripts, jvm, stress, shim, platforms, csharp, assets, faults, exits,
soak, roundtrip, page, site, acceptance, experiments, chaos, fuzz, bench, gradle. These suites run only if named: platforms-all, workflows, site, ray (a
cluster), maven, jvm-repeats, acceptance-slow, experiments-slow, csharp-on-coreclr, csharp-slow-on-coreclr, and repetitions on other JDKs.
cmake/Tests.cmake declares the suites.

gradle needs Gradle on the PATH or in COLLEKTIVE_GRADLE, and is skipped otherwise. platforms tests the code of the native library that depends on the
processor, for Linux on ARM64 under qemu. platforms-all tests the whole library, also for Windows under Wine. Both are skipped if these emulators cannot be
installed. csharp runs on Mono, and on CoreCLR if named.

`test PROJECT` compiles and runs the Kotlin tests of a project: JUnit tests in the folder `tests` beside its programs. PROJECT is a scenario or a
folder with scenarios.

`test bare [ROOT]...` tests the last commit as root in fresh installations of debian-12, debian-13 and ubuntu-24.04, or the named ones. A system
whose packages cannot be fetched is skipped. `test bare container` follows the Dockerfile in debian-12, and runs commands without a network.

The last line is "N passed, N failed". The exit code is 1 if a test failed. JUnit XML files are in build/results. If the public API of the JVM side
changed, the suite jvm prints the difference and the command that accepts it."""
import argparse
import json
import re
import shutil
import site
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from build import fetch, graph, lock, processes, project_tests, system
from build.console import Failure, print_progress
from build.places import BUILD, GRAPH, RESULTS, ROOT, TEST_PYTHON

RUNS = frozenset({"quick", "all", "extra"})


class LongRun(NamedTuple):
    """An option that runs one script of scripts/tests and shows its output."""

    file: str
    targets: tuple[str, ...]
    words: tuple[str, ...]
    help: str


LONG_RUNS = {
    "faults": LongRun("faults/faults.py", ("runtime", "csharp_tests", "incompatible_host"), ("--all",),
                      "inject each fault of scripts/tests/faults/faults.json (or those whose name contains WORDS) on every runtime and JVM"),
    "exits": LongRun("faults/exits.py", ("runtime", "csharp_tests"), ("200",), "end 200 runs in different ways: scene change, quit, Ctrl-C, "
                     "unhandled exceptions"),
    "chaos": LongRun("chaos/chaos.py", ("runtime", "replay_page", "failing"), ("200", "20", "50", "5", "500", "--seed"), "disturb 780 runs: kill, "
                     "signals, full and read-only disks, clock changes, low memory, a failing system call; checks that no run is falsely "
                     "complete, no process is left and no earlier result is lost"),
    "soak": LongRun("soak.py", ("runtime", "csharp_tests"), (), "run a scene that adds and removes nodes; memory, threads and descriptors must not grow "
                    "after the first minute"),
    "stress": LongRun("stress.py", ("jvm_modules",), (str(RESULTS / "stress-full/stress.xml"), "-m", "default", "-af", "NONE"), "test races "
                      "between JVM threads with all combinations of JIT compilers (takes a long time)"),
    "fuzz": LongRun("fuzz.py", ("runtime", "jvm_tests", "roundtrip", "Collektive.Fuzz.exe", "failing"), ("--each",), "run each fuzzer, or the named "
                    "ones, for 5 or MINUTES: open, step and control (frames), record, scenario, schemas, shim (calls in any order, under sanitizers), "
                    "experiments; keeps its corpus in build/fuzz"),
}


class Suite(NamedTuple):
    """A suite as CTest knows it. Its labels are the runs that it is part of, and its area. `targets` and `tools` are what it needs."""

    name: str
    labels: frozenset[str]
    is_disabled: bool = False
    targets: frozenset[str] = frozenset()
    tools: frozenset[str] = frozenset()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("suites", nargs="*", metavar="SUITE|PROJECT")
    only = parser.add_mutually_exclusive_group()
    only.add_argument("--quick", action="store_const", const=["quick"], dest="run_of", help="run most suites on one JDK without slow tests, in about six "
                      "minutes on two idle cores")
    only.add_argument("--sanitize", action="store_const", const=["sanitized"], dest="run_of", help="run the tests of the native library under "
                      "AddressSanitizer and UndefinedBehaviorSanitizer")
    only.add_argument("--faults", nargs="*", metavar="WORDS", help=LONG_RUNS["faults"].help)
    only.add_argument("--chaos", nargs="?", const="1", metavar="SEED", help=LONG_RUNS["chaos"].help)
    only.add_argument("--soak", type=_minutes, metavar="MINUTES", help=LONG_RUNS["soak"].help)
    only.add_argument("--fuzz", nargs="*", metavar="NAME|MINUTES|SEED", help=LONG_RUNS["fuzz"].help)
    for name in ("exits", "stress"):
        only.add_argument(f"--{name}", action="store_const", const=[], help=LONG_RUNS[name].help)


def _minutes(text: str) -> str:
    if not re.fullmatch(r"\d*\.?\d+", text):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of minutes")
    return text


def run(arguments: argparse.Namespace) -> int:
    values = {name: getattr(arguments, name) for name in LONG_RUNS if getattr(arguments, name) is not None}
    if arguments.suites and (values or arguments.run_of):
        chosen = f"--{next(iter(values))}" if values else "--quick" if arguments.run_of == ["quick"] else "--sanitize"
        raise Failure(f"test: '{arguments.suites[0]}' cannot be combined with an option: {chosen} takes no suites")
    for name, value in values.items():
        return run_long(LONG_RUNS[name], [value] if isinstance(value, str) else value)
    if arguments.suites[:1] == ["bare"]:
        return bare(arguments.suites[1:])
    if any(is_project(word) for word in arguments.suites):
        return test_projects([Path(word) for word in arguments.suites])
    return test(arguments.run_of or arguments.suites or ["all"])


def run_long(long_run: LongRun, values: Sequence[str]) -> int:
    """Runs the script of an option."""
    prepare()
    graph.build(*long_run.targets)
    # These lock the outputs themselves, and would wait for this lock.
    if long_run.file in ("chaos/chaos.py", "fuzz.py"):
        lock.release()
    return processes.call([TEST_PYTHON, "-I", "-B", ROOT / "scripts/tests" / long_run.file, *long_run.words, *values])


def bare(roots: Sequence[str]) -> int:
    """Tests the last commit in fresh installations of distributions."""
    setup_environment()
    from tests import bare as fresh
    from tests import results
    unknown = [name for name in roots if name not in fresh.ROOTS]
    if unknown:
        raise Failure(f"test bare: unknown system '{unknown[0]}'; known: {' '.join(fresh.ROOTS)}")
    failure, skipped = fresh.test(roots or list(fresh.ROOTS), RESULTS / "bare")
    cases = results.read(RESULTS / "bare", failure) if skipped < len(roots or fresh.ROOTS) else []
    return results.verdict({"bare": cases}, RESULTS, skipped)


def is_project(word: str) -> bool:
    """Returns whether a word is a path, not a suite. Some folders of this checkout have the names of suites, but contain no scenarios."""
    path = Path(word)
    return path.is_file() or (path.is_dir() and (path.resolve().parent != ROOT or any(file.name != "package.json" for file in path.glob("*.json"))))


def test_projects(paths: Sequence[Path]) -> int:
    """Runs the Kotlin tests of users' projects."""
    graph.build("runtime", "jvm_modules")
    setup_environment()
    from tests import junit, results
    shutil.rmtree(RESULTS / "projects", ignore_errors=True)
    cases: dict[str, list[junit.Case]] = {}
    for path in paths:
        name = path.resolve().name
        # Projects in different folders may have the same name.
        while name in cases:
            name += "-again"
        code = project_tests.run(path, RESULTS / "projects" / name)
        cases[name] = results.read(RESULTS / "projects" / name, "JUnit found no tests, or ended early" if code else "")
    return results.verdict(cases, RESULTS / "projects")


def prepare() -> None:
    """Installs system packages that suites need, and configures the build graph, which declares the suites."""
    system.setup_system()
    try:
        system.setup_nunit()
    except Failure as failure:
        print_progress(f"skipping the C# tests: {failure}")
    lock.shared()
    # One call fetches them in parallel.
    fetch.fetch("python", *fetch.BASE)
    setup_environment()
    graph.build("build.ninja")


def setup_environment() -> None:
    """Adds the packages of the test environment to this process, which reads results."""
    lock.shared()
    fetch.fetch("python")
    for folder in (BUILD / "python/lib").glob("python*/site-packages"):
        site.addsitedir(str(folder))


def test(words: Sequence[str]) -> int:
    """Runs suites and adds up their results."""
    prepare()
    from tests import results
    suites = select_suites(read_suites(), words)
    # One call for all targets and tools uses the processors better than the fixtures of the suites.
    tools = sorted({tool for suite in suites for tool in suite.tools})
    # Ninja 1.11 begins with the first target. After jvm_tests, Maven has nothing to do for the other targets of the JVM side.
    targets = sorted({target for suite in suites for target in suite.targets}, key=lambda target: (target != "jvm_tests", target))
    try:
        graph.build(*(targets or ["build.ninja"]), tools=tools)
    except (Failure, OSError, subprocess.CalledProcessError):
        if processes.was_interrupted():
            raise
    # Each suite locks the outputs itself, and its fixtures retry failed tools and targets.
    lock.release()
    for suite in suites:
        shutil.rmtree(RESULTS / suite.name, ignore_errors=True)
    failures = run_suites([suite.name for suite in suites])
    return results.verdict({suite.name: results.read(RESULTS / suite.name, failures.get(suite.name, "did not run")) for suite in suites}, RESULTS)


def read_suites() -> list[Suite]:
    """Returns the suites of the build graph."""
    output = subprocess.run(["ctest", "--test-dir", GRAPH, "--show-only=json-v1"], stdout=subprocess.PIPE, check=True).stdout
    suites = []
    for test in json.loads(output)["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test["properties"]}
        labels = frozenset(properties.get("LABELS", []))
        if labels & RUNS:
            fixtures = properties.get("FIXTURES_REQUIRED", [])
            targets = frozenset(name.removeprefix("build-") for name in fixtures if name.startswith("build-"))
            tools = frozenset(tool for tool in fetch.FETCHERS if f"setup-{tool}" in fixtures)
            suites.append(Suite(test["name"], labels, properties.get("DISABLED", False), targets, tools))
    return suites


def select_suites(suites: Sequence[Suite], words: Sequence[str]) -> list[Suite]:
    """Returns the suites of these names, areas or runs, in their order."""
    names = {suite.name for suite in suites}
    chosen: set[Suite] = set()
    for word in words:
        labelled = [suite for suite in suites if word in suite.labels]
        # An area selects the suites that a run of all suites has of it, so that both give the same result.
        whole = [suite for suite in labelled if word == "quick" or "all" in suite.labels]
        found = [suite for suite in suites if suite.name == word] or whole or labelled
        if not found:
            areas = dict.fromkeys(area for suite in suites for area in suite.labels - RUNS)
            raise Failure(f"test: unknown suite '{word}'; known: areas {' '.join(areas)}; suites {' '.join(sorted(names - areas.keys()))}")
        chosen |= set(found)
    disabled = [suite.name for suite in suites if suite in chosen and suite.is_disabled]
    if disabled:
        text = f"{', '.join(disabled)}: this system has no package for NUnit 2.6"
        if len(disabled) == len(chosen):
            raise Failure(f"test: {text}")
        print_progress(f"skipped {text}")
    return [suite for suite in suites if suite in chosen and not suite.is_disabled]


def run_suites(names: Sequence[str]) -> dict[str, str]:
    """Runs suites with CTest. Returns the failure that CTest reports for each suite, or an empty string."""
    report = RESULTS / "ctest.xml"
    report.unlink(missing_ok=True)
    pattern = "|".join(re.sub(r"[.+]", r"\\\g<0>", name) for name in names)
    command: list[str | Path] = ["ctest", "--test-dir", GRAPH, "-j", "3", "--output-on-failure", "--output-junit", report, "-R", f"^({pattern})$"]
    processes.call(command, stdout=sys.stderr.fileno())
    if not report.exists():
        raise Failure("test: CTest ended before it wrote its results; the messages are above")
    from tests import junit
    return {case.name.split(".")[-1]: case.failure for case in junit.read(str(report))}
