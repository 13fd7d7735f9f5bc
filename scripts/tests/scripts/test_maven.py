"""Tests that the JVM build compiles only modules that changed, and modules to which the change is visible, and that its jars equal those of a full build."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from checkout import Checkout

from build.places import BUILD, JVM

DEPENDENCY = ("<dependencies><dependency><groupId>org.collektive</groupId><artifactId>lower</artifactId>"
              "<version>${project.version}</version></dependency></dependencies>")
LOWER = "lower/src/main/kotlin/Lower.kt"
UPPER = "upper/src/main/kotlin/Upper.kt"


class Modules:
    """A checkout whose JVM side has two modules with tests: `upper` depends on `lower`."""

    def __init__(self, checkout: Checkout) -> None:
        self.root = checkout.root
        self.jvm = checkout.root / "jvm-host"
        (self.root / ".mvn").mkdir()
        (self.root / "build").mkdir()
        (self.root / "build/kotlinc").symlink_to(BUILD / "kotlinc")
        parent = (JVM / "pom.xml").read_text()
        (self.jvm / "pom.xml").write_text(
            re.sub("<modules>.*</modules>", "<modules><module>lower</module><module>upper</module></modules>", parent, flags=re.DOTALL))
        head = re.sub("</parent>.*", "</parent>", (JVM / "api/pom.xml").read_text(), flags=re.DOTALL)
        for module, dependencies in ("lower", ""), ("upper", DEPENDENCY):
            self.write(f"{module}/pom.xml", f"{head}<artifactId>{module}</artifactId>{dependencies}</project>")
        self.write(LOWER, "public inline fun inlined(value: () -> Int): Int = value() + 1\npublic fun ordinary(): Int = 1\n")
        self.write(UPPER, "public fun above(): Int = inlined { ordinary() }\n")
        self.write("lower/src/test/kotlin/LowerTest.kt", "internal val below = ordinary()\n")
        self.write("upper/src/test/kotlin/UpperTest.kt", "internal val higher = above()\n")

    def write(self, path: str, text: str) -> None:
        """Writes a file of the JVM side."""
        (self.jvm / path).parent.mkdir(parents=True, exist_ok=True)
        (self.jvm / path).write_text(text)

    def edit(self, path: str, old: str, new: str) -> None:
        """Replaces a part of a file. The file must contain this part."""
        text = (self.jvm / path).read_text()
        assert old in text
        self.write(path, text.replace(old, new))

    def build(self) -> set[str]:
        """Builds and returns the names of the classes that were compiled."""
        before = self._classes()
        # With this option, Maven prints the version of its JVM in each call.
        result = subprocess.run([sys.executable, "-I", self.root / "scripts/build/maven.py", self.root / "build/stamp", "--tests"],
                                text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "MAVEN_OPTS": "-showversion"})
        self.output = result.stdout
        self.maven_calls = result.stdout.count("Runtime Environment")
        after = self._classes()
        return {path.stem for path in after if after[path] != before.get(path)} if result.returncode == 0 else {"an error"}

    def jars(self) -> dict[str, bytes]:
        """Returns the contents of the jars of all modules."""
        return {path.name: path.read_bytes() for path in self.jvm.rglob("*.jar")}

    def _classes(self) -> dict[Path, int]:
        return {path: os.stat(path).st_mtime_ns for path in self.jvm.rglob("*.class")}


@pytest.fixture
def modules(checkout: Checkout) -> Modules:
    return Modules(checkout)


def test_modules_are_compiled_when_they_or_their_dependencies_changed(modules: Modules) -> None:
    assert modules.build() == {"LowerKt", "UpperKt", "LowerTestKt", "UpperTestKt"}, modules.output
    assert modules.build() == set(), "without a change, nothing may be compiled"
    modules.edit(LOWER, "ordinary(): Int = 1", "ordinary(): Int = 2")
    assert modules.build() == {"LowerKt"}, "the body of a function is not visible to other modules"
    assert modules.maven_calls == 1, modules.output
    modules.edit(LOWER, "value() + 1", "value() + 2")
    assert modules.build() == {"LowerKt", "UpperKt", "LowerTestKt", "UpperTestKt"}, "callers contain the body of an inline function, so they must be compiled"
    modules.edit("lower/src/test/kotlin/LowerTest.kt", "below", "lowest")
    assert modules.build() == {"LowerTestKt"}, "tests are not visible to other modules"
    # Callers of inline functions contain line numbers of their source.
    modules.edit(LOWER, "public inline", "\n\npublic inline")
    modules.build()
    jars = modules.jars()
    for module in ("lower", "upper"):
        shutil.rmtree(modules.jvm / module / "target")
    modules.build()
    assert modules.jars() == jars


def test_changed_modules_do_not_see_outdated_classes(modules: Modules) -> None:
    modules.edit("pom.xml", "<module>upper</module>", "<module>upper</module><module>top</module>")
    modules.write("top/pom.xml", (modules.jvm / "upper/pom.xml").read_text().replace("<artifactId>lower", "<artifactId>upper").replace(
        "<artifactId>upper</artifactId><dep", "<artifactId>top</artifactId><dep"))
    modules.write(LOWER, "package first\npublic class First\npublic open class Base\n")
    modules.write("lower/src/main/kotlin/Second.kt", "package second\npublic class Second\n")
    modules.write(UPPER, "import first.*\nimport second.*\npublic class Derived : Base()\n")
    modules.write("top/src/main/kotlin/Top.kt", "public val top: Int = Derived().hashCode()\n")
    for module in ("lower", "upper"):
        shutil.rmtree(modules.jvm / module / "src/test")
    modules.build()
    modules.write(LOWER, "package first\npublic class First\n")
    modules.write("lower/src/main/kotlin/Second.kt", "package second\npublic class Second\npublic open class Base\n")
    modules.edit("top/src/main/kotlin/Top.kt", "hashCode()", "toString().length")
    assert modules.build() == {"First", "Second", "Base", "Derived", "TopKt"}, modules.output


def test_an_error_is_reported_until_it_is_fixed(modules: Modules) -> None:
    modules.build()
    modules.edit(LOWER, "ordinary", "renamed")
    modules.edit("lower/src/test/kotlin/LowerTest.kt", "ordinary", "renamed")
    for _ in range(2):
        assert modules.build() == {"an error"}
        assert "Unresolved reference 'ordinary'" in modules.output
    modules.edit(UPPER, "ordinary", "renamed")
    assert modules.build() == {"UpperKt", "UpperTestKt", "LowerTestKt"}, modules.output
