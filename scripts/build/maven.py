"""Builds the JVM side with Maven, and compiles only modules that changed.

`maven.py STAMP [--tests] MODULE...` packages modules and their dependencies, and then touches STAMP. With --tests, it also compiles their tests.

Maven has no reliable incremental build across modules, because the incremental build of Kotlin does not detect changes in other modules. This script
therefore compares the inputs of each module with those of its last build. The inputs are the module's sources, its POM, the files that the POM names,
and the ABI of its dependencies, which Kotlin's build tools hash.

While Maven runs, the steps that are not needed are marked, and profiles of the parent POM skip them. The outputs of all other steps are removed first.
"""
import hashlib
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Sequence
from functools import cached_property
from itertools import chain
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from build import maven_repository
from build.depfile import inputs
from build.jdk import find_jdk
from build.places import BUILD, JVM, ROOT

PARENT = JVM / "pom.xml"
NAMESPACE = {"m": "http://maven.apache.org/POM/4.0.0"}
# Names of the files in a module's target/ that activate profiles of the parent POM.
MAIN_MARK, PACKAGE_MARK, TESTS_MARK = "main-unchanged", "package-unchanged", "tests-unchanged"
STARTED = BUILD / "maven-started"
WITHOUT_TESTS = "-Dmaven.test.skip=true"
# With these options, Maven builds a few modules twice as fast. For many modules, it is faster with the second JIT compiler.
SHORT_CALL = "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC"
FEW_MODULES = 3


class Module:
    """A module of the Maven build. Each build stores the hashes of the module's inputs in target/."""

    def __init__(self, name: str, modules: "dict[str, Module]") -> None:
        self.name = name
        self.folder = JVM / name
        self.target = self.folder / "target"
        self._modules = modules
        self._pom = (self.folder / "pom.xml").read_text()

    @cached_property
    def upstream(self) -> "list[Module]":
        """All modules on which this module and its plugins depend."""
        return _closure(self.direct(tests=False))

    @cached_property
    def upstream_of_tests(self) -> "list[Module]":
        """This module and all modules on which its tests depend."""
        return [self, *_closure([*self.upstream, *self.direct(tests=True)])]

    def direct(self, tests: bool) -> "list[Module]":
        """Returns the modules on which this module and its plugins depend directly. With `tests`, returns the modules on which only the tests depend."""
        found = []
        for dependency in ElementTree.fromstring(self._pom).findall(".//m:dependency", NAMESPACE):
            name = dependency.findtext("m:artifactId", "", NAMESPACE)
            if name in self._modules and (dependency.findtext("m:scope", "", NAMESPACE) == "test") == tests:
                found.append(self._modules[name])
        return found

    @cached_property
    def build_key(self) -> str:
        """Returns a hash of all inputs of the module's outputs."""
        return _hash([], [self._main_files, *(module.build_key for module in self.upstream)])

    def main_key(self) -> str:
        """Returns a hash of all inputs of the module's classes."""
        return _hash([], [self._main_files, *self._seen(self.upstream)])

    def tests_key(self) -> str:
        """Returns a hash of all inputs of the module's test classes."""
        return _hash([], [self._test_files, *self._seen(self.upstream_of_tests)])

    # Files are hashed once, before Maven reads them, so that the next build compiles files that changed during this build.
    @cached_property
    def _main_files(self) -> str:
        return _hash([self.folder / "src/main", *self._named], [])

    @cached_property
    def _test_files(self) -> str:
        sources = [path for path in sorted((self.folder / "src").glob("*")) if path.name != "main"]
        fixtures = [(self.folder / path).resolve() for path in re.findall(r">(\.\./[\w-]+/src/[^<]+)<", self._pom)]
        return _hash([*sources, *fixtures, *self._named], [])

    def stored(self, name: str) -> str:
        """Returns the text that the last build stored as target/NAME, or an empty string."""
        file = self.target / name
        return file.read_text() if file.exists() else ""

    def store(self, name: str, text: str) -> None:
        """Stores a text as target/NAME."""
        (self.target / name).write_text(text)

    def remove_main(self) -> None:
        """Removes all outputs except the test classes."""
        for path in self.target.glob("*"):
            if path.is_dir() and path.name != "test-classes":
                shutil.rmtree(path)
            elif path.is_file() and path.name != "tests.key":
                path.unlink()

    def _seen(self, modules: "Iterable[Module]") -> list[str]:
        return [module.build_key if module in self._tools else module.stored("abi") for module in modules]

    @cached_property
    def _tools(self) -> "list[Module]":
        # These modules run during the build of this module. They are dependencies of its plugins, or the module names their jars by a property of the parent.
        plugins = ElementTree.fromstring(self._pom).iterfind(".//m:plugin//m:artifactId", NAMESPACE)
        jars = re.findall(r"<([\w.]+)>\$\{root\}/jvm-host/([\w-]+)/target/", PARENT.read_text())
        names = {element.text or "" for element in plugins} | {module for name, module in jars if f"${{{name}}}" in self._pom}
        return _closure(self._modules[name] for name in names & self._modules.keys())

    @cached_property
    def _named(self) -> list[Path]:
        return [PARENT, self.folder / "pom.xml", BUILD / "stamp/flatbuffers", *(ROOT / path for path in re.findall(r"\$\{root\}/([^<]+)", self._pom))]


def package(names: list[str], tests: bool) -> int:
    """Builds modules and returns Maven's exit code."""
    modules = read_modules()
    chosen = closure(names, modules)
    if STARTED.exists():
        # An interrupted build may have left an incomplete output.
        for module in chosen:
            shutil.rmtree(module.target, ignore_errors=True)
    STARTED.parent.mkdir(parents=True, exist_ok=True)
    STARTED.touch()
    changed, code = _changed(chosen), 0
    # A module between two changed modules is compiled with them, because the upper one must not be compiled with its outdated classes.
    changed.update(module for module in chosen if changed.intersection(module.upstream) and any(module in upper.upstream for upper in changed))
    if any(changed.intersection(module.upstream) for module in chosen if module not in changed):
        # Other modules are compiled only if the change is visible to them. It rarely is, so this call already packages everything.
        code = run(chosen, changed, ["package", WITHOUT_TESTS], tests=False)
        changed = _changed(chosen)
        changed.update(module for module in chosen if changed.intersection(module.upstream))
    if code == 0:
        code = run(chosen, changed, ["package", "-DskipTests" if tests else WITHOUT_TESTS], tests)
    STARTED.unlink()
    return code


def run(modules: Sequence[Module], changed: set[Module], words: Sequence[str], tests: bool) -> int:
    """Runs Maven on modules, compiles the changed modules, and returns Maven's exit code.

    Removes the marks afterwards, so that Maven compiles everything if a user runs it directly.
    """
    packaged = [module for module in modules if changed.intersection([module, *module.upstream]) or module.stored("build.key") != module.build_key]
    tested = [module for module in modules if tests and (
        module.stored("tests.key") != module.tests_key() or changed.intersection(module.upstream_of_tests))]
    if not packaged and not tested and "package" in words:
        return 0
    # A build that was killed may have left marks.
    _unmark(modules)
    for module in modules:
        module.target.mkdir(exist_ok=True)
        if module in changed:
            module.remove_main()
        else:
            module.store(MAIN_MARK, "")
        if module in packaged:
            shutil.rmtree(module.target / "lib", ignore_errors=True)
        else:
            module.store(PACKAGE_MARK, "")
        if module in tested:
            shutil.rmtree(module.target / "test-classes", ignore_errors=True)
            (module.target / "tests.key").unlink(missing_ok=True)
        elif tests:
            module.store(TESTS_MARK, "")
    names = ",".join(module.name for module in modules)
    command: list[str | Path] = ["mvn", "-B", "-ntp", "-q", "-Dstyle.color=never", "-T", "2", "-f", PARENT, "-pl", names, *words]
    options = [os.environ.get("MAVEN_OPTS", ""), SHORT_CALL if max(len(changed), len(tested)) <= FEW_MODULES else ""]
    try:
        environment = {**os.environ, "MAVEN_OPTS": " ".join(options)}
        code = subprocess.run(command, env=environment).returncode
        if code != 0 and maven_repository.repair():
            code = subprocess.run(command, env=environment).returncode
    finally:
        _unmark(modules)
    if code == 0 and "package" in words:
        _store_abis([module for module in modules if module in changed and (module.target / "classes").exists()])
        for module in modules:
            if module in changed:
                module.store("main.key", module.main_key())
            if module in packaged:
                module.store("build.key", module.build_key)
            if module in tested:
                module.store("tests.key", module.tests_key())
    return code


def _changed(modules: Iterable[Module]) -> set[Module]:
    return {module for module in modules if module.stored("main.key") != module.main_key()}


def _store_abis(modules: Sequence[Module]) -> None:
    if not modules:
        return
    java: list[str | Path] = [find_jdk() / "bin/java", "-XX:TieredStopAtLevel=1", "-XX:+UseSerialGC", "-cp", f"{BUILD}/kotlinc/*"]
    command = [*java, Path(__file__).with_name("Abi.java"), *(module.target / "classes" for module in modules)]
    printed = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    for module, part in zip(modules, printed.split(f"{JVM}/")[1:], strict=True):
        module.store("abi", _hash([], [part]))


def _unmark(modules: Iterable[Module]) -> None:
    for module in modules:
        for mark in (MAIN_MARK, PACKAGE_MARK, TESTS_MARK):
            (module.target / mark).unlink(missing_ok=True)


def _closure(modules: Iterable[Module]) -> list[Module]:
    return list(dict.fromkeys(chain.from_iterable([module, *module.upstream] for module in modules)))


def read_modules() -> dict[str, Module]:
    """Returns the modules that the parent POM lists, by name."""
    modules: dict[str, Module] = {}
    for element in ElementTree.parse(PARENT).getroot().findall("m:modules/m:module", NAMESPACE):
        name = element.text or ""
        modules[name] = Module(name, modules)
    return modules


def closure(names: list[str], modules: dict[str, Module]) -> list[Module]:
    """Returns the named modules, their dependencies, and the dependencies of their tests. Without names, returns all modules."""
    found: dict[str, Module] = {}

    def add(module: Module) -> None:
        if module.name not in found:
            found[module.name] = module
            for upstream in module.direct(tests=False) + module.direct(tests=True):
                add(upstream)

    for name in names or modules:
        add(modules[name])
    return list(found.values())


def _hash(paths: list[Path], texts: list[str]) -> str:
    digest = hashlib.sha256()
    for path in paths:
        for file in inputs([path]):
            digest.update(f"{file.relative_to(ROOT)}\0".encode())
            if file.is_file():
                digest.update(hashlib.sha256(file.read_bytes()).digest())
    for text in texts:
        digest.update(text.encode() + b"\0")
    return digest.hexdigest()


if __name__ == "__main__":
    stamp, *arguments = sys.argv[1:]
    with_tests = "--tests" in arguments
    result = package([word for word in arguments if not word.startswith("--")], with_tests)
    if result == 0:
        Path(stamp).parent.mkdir(parents=True, exist_ok=True)
        Path(stamp).touch()
    sys.exit(result)
