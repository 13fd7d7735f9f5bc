"""Tests that the build graph builds only changed targets, and that it recovers from interruptions."""
import os
import re
import subprocess
import time
from pathlib import Path

import pytest
from checkout import Checkout

from build import maven
from build.places import GRAPH, ROOT

CMAKE = """
cmake_minimum_required(VERSION 3.25)
project(it NONE)
add_custom_command(OUTPUT out COMMAND sh "${PROJECT_SOURCE_DIR}/step" "${PROJECT_SOURCE_DIR}"
  DEPENDS "${PROJECT_SOURCE_DIR}/in" VERBATIM)
add_custom_target(thing DEPENDS out)
add_custom_target(broken COMMAND sh -c "echo this is why; exit 1" VERBATIM)
"""
STEP = 'echo made >>"$1/made" && cat "$1/gate" && cp "$1/in" out'
BUILD = "fetch.BASE = ()\ntry: graph.build('{}')\nexcept Failure as failure: sys.exit(f'collektive: {{failure}}')\n"
MODULE = BUILD.format("thing")
WAITING = "waiting for another collektive command"


@pytest.fixture
def project(checkout: Checkout) -> Checkout:
    (checkout.root / "CMakeLists.txt").write_text(CMAKE)
    (checkout.root / "in").write_text("one")
    (checkout.root / "step").write_text(STEP)
    return checkout


def test_tools_are_fetched_while_targets_are_built(project: Checkout) -> None:
    project.close_gate()
    # Each side of the gate waits for the other.
    tool = "fetch.BASE = (); fetch.FETCHERS['tool'] = ([], lambda folder: print((root / 'gate').write_text('')))\n"
    for expected in ("0\n", ""):
        result = project.run(f"{tool}graph.build('thing', tools=['tool'])")
        assert (result.returncode, result.stdout) == (0, expected), result.stderr
    assert project.log_lines() == ["made"]


def test_only_changed_targets_are_built(project: Checkout) -> None:
    for text in ["one", "one", "two", "two"]:
        if (project.root / "in").read_text() != text:
            time.sleep(0.02)
            (project.root / "in").write_text(text)
        assert project.run(MODULE).returncode == 0
        assert (project.root / "build/cmake/out").read_text() == text
    assert project.log_lines() == ["made", "made"]


@pytest.mark.parametrize("folder", ["schema", "scripts/build"])
@pytest.mark.parametrize("case", ["during the build", "copied", "clock set back"])
def test_changes_are_built_whatever_the_time_of_the_file(project: Checkout, case: str, folder: str) -> None:
    """Tests a file that changes after a step has read it, a restored copy with an earlier time, and a change that seems to be older than the last build."""
    (project.root / "CMakeLists.txt").write_text(CMAKE.replace("/in", f"/{folder}/in"))
    (project.root / "step").write_text(f'text=$(cat "$1/{folder}/in") && cat "$1/gate" && echo made >>"$1/made" && printf %s "$text" >out')
    source = project.root / folder / "in"
    source.parent.mkdir(exist_ok=True)
    source.write_text("one")
    if case != "during the build":
        assert project.run(MODULE).returncode == 0
        source.write_text("two")
        os.utime(source, (0, 0))
        if case == "clock set back":
            os.utime(project.root / "build/cmake/begin")
    else:
        project.close_gate()
        build = project.start(MODULE)
        with open(project.root / "gate", "w"):
            time.sleep(0.02)
            source.write_text("two")
            time.sleep(0.02)
        assert build.wait() == 0
        project.open_gate()
    for _ in range(2):
        assert project.run(MODULE).returncode == 0
        assert (project.root / "build/cmake/out").read_text() == "two"
    assert project.log_lines() == ["made", "made"]


def test_changes_are_built_while_outputs_have_times_in_the_future(project: Checkout) -> None:
    """Tests a clock that was set back before the change, and was not corrected."""
    schema, tree, later = project.root / "schema", project.root / "build/cmake", time.time() + 3600
    schema.mkdir()
    (schema / "in").write_text("one")
    (project.root / "CMakeLists.txt").write_text(CMAKE.replace("/in", "/schema/in"))
    (project.root / "step").write_text(STEP.replace("/in", "/schema/in"))
    assert project.run(MODULE).returncode == 0
    log = tree / ".ninja_log"
    log.write_text(re.sub(r"(?m)^(\d+\t\d+\t)\d+", rf"\g<1>{int(later * 1e9)}", log.read_text()))
    for path in (log, tree / "out", tree / "build.ninja"):
        os.utime(path, (later, later))
    (schema / "in").write_text("two")
    for _ in range(2):
        assert project.run(MODULE).returncode == 0
        assert (tree / "out").read_text() == "two"
    assert project.log_lines() == ["made", "made"]


def test_sources_with_a_time_in_the_future_are_built_once(project: Checkout) -> None:
    schema = project.root / "schema"
    schema.mkdir()
    (schema / "in").write_text("one")
    dependency = f'set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "{schema}")\n'
    (project.root / "CMakeLists.txt").write_text(CMAKE.replace("/in", "/schema/in") + dependency)
    (project.root / "step").write_text(STEP.replace("/in", "/schema/in"))
    for path in (schema / "in", schema):
        os.utime(path, (time.time() + 3600, time.time() + 3600))
    for _ in range(2):
        assert project.run(MODULE).returncode == 0
    assert project.log_lines() == ["made"]


@pytest.mark.parametrize("hours", [-1, 1])
def test_a_linked_source_is_built_without_changing_its_time(project: Checkout, hours: int) -> None:
    schema = project.root / "schema"
    schema.mkdir()
    target = project.root.parent / "in"
    target.write_text("one")
    (schema / "in").symlink_to(target)
    (project.root / "CMakeLists.txt").write_text(CMAKE.replace("/in", "/schema/in"))
    (project.root / "step").write_text(STEP.replace("/in", "/schema/in"))
    assert project.run(MODULE).returncode == 0
    target.write_text("two")
    changed = int(time.time()) + hours * 3600
    os.utime(target, (changed, changed))
    assert project.run(MODULE).returncode == 0
    assert (project.root / "build/cmake/out").read_text() == "two"
    assert target.stat().st_mtime == changed


def test_a_configuration_with_an_earlier_time_is_used(project: Checkout) -> None:
    assert project.run(MODULE).returncode == 0
    (project.root / "CMakeLists.txt").write_text(CMAKE.replace('sh "${PROJECT_SOURCE_DIR}/step"', 'touch out "${PROJECT_SOURCE_DIR}/other" COMMAND sh -c :'))
    os.utime(project.root / "CMakeLists.txt", (0, 0))
    assert project.run(MODULE).returncode == 0
    assert (project.root / "other").exists()


def test_a_source_that_is_deleted_before_a_build_is_skipped(project: Checkout) -> None:
    result = project.run(f"graph._missed = lambda: [str(root / 'deleted')]\n{MODULE}")
    assert (result.returncode, project.log_lines()) == (0, ["made"]), result.stderr


def test_an_up_to_date_build_does_not_wait_for_runs(project: Checkout) -> None:
    assert project.run(MODULE).returncode == 0
    project.close_gate()
    use = project.start("lock.shared(); wait_at_gate()")
    with open(project.root / "gate", "w"):
        assert project.run(MODULE).stderr == ""
        (project.root / "in").write_text("two")
        build = project.start(MODULE)
        assert build.stderr is not None
        assert WAITING in build.stderr.readline()
    assert use.wait() == 0
    project.open_gate()
    assert build.wait() == 0


def test_a_killed_build_starts_over(project: Checkout) -> None:
    project.close_gate()
    process = project.start(MODULE)
    with open(project.root / "gate", "w"):
        project.kill(process)
    project.open_gate()
    assert project.run(MODULE).returncode == 0
    assert project.log_lines() == ["made", "made"]
    assert (project.root / "build/cmake/out").read_text() == "one"


def test_an_error_is_shown_and_ends_the_command(project: Checkout) -> None:
    result = project.run(BUILD.format("broken"))
    assert result.returncode == 1
    assert "this is why" in result.stderr
    assert result.stderr.endswith("collektive: the build failed; the messages are above\n")


def test_a_failed_configuration_has_no_effect_on_later_builds(project: Checkout) -> None:
    recording = 'file(WRITE "${CMAKE_BINARY_DIR}/seen" "${COLLEKTIVE_NUNIT}")\nif(COLLEKTIVE_NUNIT MATCHES other)\n  message(FATAL_ERROR no)\nendif()\n'
    (project.root / "CMakeLists.txt").write_text(CMAKE + recording)
    (project.root / "other").touch()
    assert project.run(MODULE).returncode == 0
    assert project.run(f"graph.NUNIT = root / 'other'\n{MODULE}").returncode == 1
    assert project.run(MODULE).returncode == 0
    assert "other" not in (project.root / "build/cmake/seen").read_text()


def test_the_build_is_configured_again_if_a_schema_is_added_or_renamed() -> None:
    inputs = subprocess.run(["ninja", "-t", "query", "build.ninja"], cwd=GRAPH, capture_output=True, text=True, check=True).stdout
    assert {str(ROOT / "unity/Samples~"), str(ROOT / "unity/Samples~/Swarm"), str(ROOT / "schema/test")} <= {line.strip("| ") for line in inputs.splitlines()}


def test_a_moved_checkout_is_configured_again(project: Checkout) -> None:
    assert project.run(MODULE).returncode == 0
    project.root = project.root.rename(project.root.with_name("moved"))
    result = project.run(MODULE)
    assert result.returncode == 0, result.stderr
    assert project.log_lines() == ["made", "made"]


def test_a_file_that_changes_during_a_build_is_compiled_by_the_next_build(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in {"ROOT": "", "JVM": "jvm-host", "PARENT": "jvm-host/pom.xml", "BUILD": "build", "STARTED": "build/maven-started"}.items():
        monkeypatch.setattr(maven, name, tmp_path / value)
    sources = [tmp_path / "jvm-host/a/src" / name for name in ("main/A.kt", "test/ATest.kt")]
    for file in [*sources, tmp_path / "build/stamp/flatbuffers"]:
        file.parent.mkdir(parents=True)
        file.touch()
    (tmp_path / "jvm-host/pom.xml").write_text('<project xmlns="http://maven.apache.org/POM/4.0.0"><modules><module>a</module></modules></project>')
    (tmp_path / "jvm-host/a/pom.xml").write_text("<project/>")
    edited: list[Path] = []

    def run(*_: object, **__: object) -> subprocess.CompletedProcess[bytes]:
        for file in edited:
            file.write_text("// changed")
        return subprocess.CompletedProcess([], 0)

    monkeypatch.setattr(subprocess, "run", run)
    for edited in [[source] for source in sources] + [[]]:
        assert maven.package(["a"], tests=True) == 0
        module = maven.read_modules()["a"]
        assert [module.stored(f"{name}.key") != key for name, key in (("main", module.main_key()), ("tests", module.tests_key()))] == [
            source in edited for source in sources]
