"""Builds the JVM side with Maven, and compiles only modules that changed.

`maven.py STAMP [--tests] MODULE...` packages modules and those that they depend on, with their compiled tests on request, then touches STAMP.

Maven has no incremental build of several modules that is sound: Kotlin's own does not see that another module has changed. So this script
compares the inputs of each module with those of its last build: its sources, its POM, the files that the POM names, and the modules that it
depends on. An unchanged module carries a mark while Maven runs, by which a profile of the parent POM skips its steps; the output of a changed one is
removed first.
"""
import hashlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Sequence
from functools import cached_property
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build.depfile import inputs
from build.places import BUILD, JVM, ROOT

PARENT = JVM / "pom.xml"
NAMESPACE = {"m": "http://maven.apache.org/POM/4.0.0"}
# Marks in a module's target/, which the parent POM's profiles look for.
MAIN_MARK, TESTS_MARK = "main-unchanged", "tests-unchanged"
STARTED = BUILD / "maven-started"


class Module:
    """One module of the reactor and the hashes of its inputs."""

    def __init__(self, name: str, modules: "dict[str, Module]") -> None:
        self.name = name
        self.folder = JVM / name
        self._modules = modules
        self._pom = ElementTree.parse(self.folder / "pom.xml").getroot()

    def upstream(self, tests: bool) -> list["Module"]:
        """Returns the modules that this one and its plugins depend on, or that only its tests depend on."""
        found = []
        for dependency in self._pom.findall(".//m:dependency", NAMESPACE):
            name = dependency.findtext("m:artifactId", "", NAMESPACE)
            if name in self._modules and (dependency.findtext("m:scope", "", NAMESPACE) == "test") == tests:
                found.append(self._modules[name])
        return found

    @cached_property
    def main_key(self) -> str:
        """Returns a hash of all that the module's jar depends on."""
        text = (self.folder / "pom.xml").read_text()
        named = [ROOT / path for path in re.findall(r"\$\{root}/([^<]+)", text)]
        upstream = [module.main_key for module in self.upstream(tests=False)]
        return _hash([PARENT, self.folder / "pom.xml", self.folder / "src/main", BUILD / "stamp/flatbuffers", *named], upstream)

    @cached_property
    def tests_key(self) -> str:
        """Returns a hash of all that the module's compiled tests depend on."""
        sources = [path for path in sorted((self.folder / "src").glob("*")) if path.name != "main"]
        fixtures = [(self.folder / path).resolve() for path in re.findall(r">(\.\./[\w-]+/src/[^<]+)<", (self.folder / "pom.xml").read_text())]
        return _hash([*sources, *fixtures], [self.main_key, *(module.main_key for module in self.upstream(tests=True))])

    def prepare(self, tests: bool) -> bool:
        """Marks what is unchanged and removes the outputs of what is not; returns whether anything has to be built."""
        target = self.folder / "target"
        if _stored(target / "main.key") != self.main_key:
            shutil.rmtree(target, ignore_errors=True)
            return True
        (target / MAIN_MARK).touch()
        if not tests:
            return False
        if _stored(target / "tests.key") != self.tests_key:
            shutil.rmtree(target / "test-classes", ignore_errors=True)
            return True
        (target / TESTS_MARK).touch()
        return False

    def record(self, tests: bool) -> None:
        """Stores the hashes after a successful build."""
        target = self.folder / "target"
        target.mkdir(exist_ok=True)
        (target / "main.key").write_text(self.main_key)
        if tests:
            (target / "tests.key").write_text(self.tests_key)


def run(modules: Iterable[Module], words: Sequence[str], tests: bool) -> tuple[int, list[Module]]:
    """Runs Maven on modules, of which it skips the steps of unchanged ones; returns its exit code and the changed modules.

    The marks are removed afterwards, so that a call of Maven by hand compiles everything.
    """
    modules = list(modules)
    # A build that was killed may have left some.
    _unmark(modules)
    try:
        changed = [module for module in modules if module.prepare(tests)]
        if not changed and "package" in words:
            return 0, []
        names = ",".join(module.name for module in modules)
        return subprocess.run(["mvn", "-B", "-ntp", "-q", "-Dstyle.color=never", "-T", "2", "-f", PARENT, "-pl", names, *words]).returncode, changed
    finally:
        _unmark(modules)


def _unmark(modules: Iterable[Module]) -> None:
    for module in modules:
        for mark in (MAIN_MARK, TESTS_MARK):
            (module.folder / "target" / mark).unlink(missing_ok=True)


def read_modules() -> dict[str, Module]:
    """Returns the modules that the parent POM lists."""
    modules: dict[str, Module] = {}
    for element in ElementTree.parse(PARENT).getroot().findall("m:modules/m:module", NAMESPACE):
        name = element.text or ""
        modules[name] = Module(name, modules)
    return modules


def closure(names: list[str], modules: dict[str, Module]) -> list[Module]:
    """Returns the named modules and all that they and their tests depend on, which Maven wants to see, or all modules if none is named."""
    found: dict[str, Module] = {}

    def add(module: Module) -> None:
        if module.name not in found:
            found[module.name] = module
            for upstream in module.upstream(tests=False) + module.upstream(tests=True):
                add(upstream)

    for name in names or modules:
        add(modules[name])
    return list(found.values())


def package(names: list[str], tests: bool) -> int:
    """Builds modules and returns Maven's exit code."""
    chosen = closure(names, read_modules())
    if STARTED.exists():
        # An interrupted build may have left half of an output.
        for module in chosen:
            shutil.rmtree(module.folder / "target", ignore_errors=True)
    STARTED.parent.mkdir(parents=True, exist_ok=True)
    STARTED.touch()
    code, changed = run(chosen, ["package", "-DskipTests" if tests else "-Dmaven.test.skip=true"], tests)
    if code == 0:
        for module in changed:
            module.record(tests)
    # After an error only the modules without a stored hash are built again.
    STARTED.unlink()
    return code


def _hash(paths: list[Path], texts: list[str]) -> str:
    digest = hashlib.sha256()
    for path in paths:
        for file in inputs([path]):
            digest.update(f"{file.relative_to(ROOT)}\0".encode())
            if file.is_file():
                digest.update(hashlib.sha256(file.read_bytes()).digest())
    for text in texts:
        digest.update(text.encode())
    return digest.hexdigest()


def _stored(file: Path) -> str:
    return file.read_text() if file.exists() else ""


if __name__ == "__main__":
    stamp, *words = sys.argv[1:]
    with_tests = "--tests" in words
    result = package([word for word in words if not word.startswith("--")], with_tests)
    if result == 0:
        Path(stamp).parent.mkdir(parents=True, exist_ok=True)
        Path(stamp).touch()
    sys.exit(result)
