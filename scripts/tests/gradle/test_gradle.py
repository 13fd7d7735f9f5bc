"""Tests that Gradle builds and tests the modules incrementally, and that its jars equal Maven's."""
import os
import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from build.places import JVM, ROOT

GRADLE = os.environ.get("COLLEKTIVE_GRADLE", "gradle")
MODULES = [pom.parent for pom in JVM.glob("*/pom.xml")]
# Entries that are not compared: folders, and files that describe the build tool.
IGNORED = re.compile(r"META-INF/(MANIFEST\.MF|maven/.*)$|.*/$")


@pytest.fixture(scope="module")
def runs() -> list[subprocess.CompletedProcess[str]]:
    """Two builds. The second one must reuse the results and the configuration of the first one."""
    if shutil.which(GRADLE) is None:
        reason = "Gradle is not on the PATH, and COLLEKTIVE_GRADLE does not name one"
        Path(os.environ["COLLEKTIVE_RESULTS"], "notes").write_text(f"gradle: skipped, {reason}\n")
        pytest.skip(reason)
    command = [GRADLE, "--no-daemon", "--console=plain", "build", "kotlinSourcesJar"]
    done = [subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) for _ in range(2)]
    print(*(run.stdout for run in done), sep="\n")
    return done


def entries(path: Path) -> dict[str, bytes | list[bytes]]:
    with zipfile.ZipFile(path) as jar:
        found = {name: jar.read(name) for name in jar.namelist() if not IGNORED.match(name)}
    # The lines of this file are sorted, because jcstress lists tests in the order in which the compiler reads the sources.
    return {name: sorted(content.splitlines()) if name == "META-INF/TestList" else content for name, content in found.items()}


def test_all_modules_are_built_and_tested(runs: list[subprocess.CompletedProcess[str]]) -> None:
    assert runs[0].returncode == 0, runs[0].stdout[-4000:]


def test_a_second_run_uses_the_configuration_cache_and_executes_nothing(runs: list[subprocess.CompletedProcess[str]]) -> None:
    assert "Configuration cache entry reused." in runs[1].stdout
    assert re.search(r"(?m)^(\d+) actionable tasks: \1 up-to-date$", runs[1].stdout)


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.name)
def test_jars_have_the_same_entries_as_mavens(module: Path, runs: list[subprocess.CompletedProcess[str]]) -> None:
    # Only the module's own jars are compared, because tests write other jars to the same folder.
    jars = [jar for jar in module.glob("target/*.jar") if re.search(r"^collektive-|-\d", jar.name)]
    assert jars
    for jar in jars:
        maven, gradle = entries(jar), entries(module / "build" / jar.name)
        assert [name for name in sorted(maven | gradle) if maven.get(name) != gradle.get(name)] == [], jar.name
