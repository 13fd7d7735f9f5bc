"""Compiles and runs the Kotlin tests of users' projects."""
from pathlib import Path

from build import fetch, inputs, player, processes, projects
from build.console import Failure, print_progress
from build.jdk import find_jdk
from build.places import ADAPTER_JAR, BUILD, HOST_JAR, LIBRARY_JAR, TESTING_JAR, compiler_plugin
from commands.check import SCENARIO, find_files


def run(project: Path, results: Path) -> int:
    """Runs the tests beside the programs of each scenario of a project, and writes JUnit XML files. Returns JUnit's exit code.

    Scenarios with the same folder of programs and identical project files share one run of the tests.
    """
    done = set()
    code = 0
    for file, kind in find_files(project):
        if kind != SCENARIO:
            continue
        plan = player.plan(str(file), [])
        parts = (plan.parts["programs"].path, *sorted(plan.hashes().items()))
        if parts not in done:
            done.add(parts)
            code = _run(file, plan, results / file.stem) or code
    # Moves the reports of all scenarios to one folder.
    for report in results.glob("*/*.xml"):
        report.rename(results / f"{report.parent.name}-{report.name}")
    return code


def _run(scenario: Path, plan: player.Plan, results: Path) -> int:
    folder = plan.parts["programs"].path.parent / "tests"
    tests = inputs.programs(folder) if folder.is_dir() else None
    if tests is None or not tests.files:
        raise Failure(f"test: {scenario}: the folder '{folder}' has no Kotlin tests: add tests to it")
    jar = plan.programs_jar()
    fetch.fetch("junit")
    jars, plugin = plan.parts.get("runtimeJars"), plan.parts.get("runtimePlugin")
    library = [ADAPTER_JAR, *jars.files.values()] if jars else [LIBRARY_JAR]
    junit = sorted((BUILD / "junit").glob("*.jar"))
    class_path = [HOST_JAR, *library, TESTING_JAR, *junit, jar]
    classes = projects.test_classes(plan.parts["schema"], tests, class_path, plugin.path if plugin else compiler_plugin())
    print_progress(f"testing {folder}")
    code = processes.call([find_jdk() / "bin/java", "-ea", "-XX:+UseSerialGC", "-cp", ":".join(map(str, [*class_path, classes])),
                           "org.junit.platform.console.ConsoleLauncher", "execute", "--disable-banner", "--details=none", "--fail-if-no-tests",
                           f"--scan-classpath={classes}", "--include-classname=.*",
                           # Otherwise, JUnit ignores private tests and tests that return a value.
                           "--config=junit.platform.discovery.issue.severity.critical=warning", f"--reports-dir={results}"])
    # A test may end the process with code 0.
    return code or int(not any(results.glob("*.xml")))
