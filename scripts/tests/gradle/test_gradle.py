"""Gradle builds and tests the modules, does nothing twice, and its jars equal Maven's."""
import os
import re
import shutil
import subprocess
import unittest
import zipfile
from pathlib import Path

from build.places import ROOT

GRADLE = os.environ.get("COLLEKTIVE_GRADLE", "gradle")
# Written by each build about itself.
OWN = re.compile(r"META-INF/(MANIFEST\.MF|maven/.*)$|.*/$")


def gradle(*tasks: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([GRADLE, "--no-daemon", "--console=plain", *tasks], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def entries(path: Path) -> dict[str, bytes | list[bytes]]:
    if not path.exists():
        return {}
    with zipfile.ZipFile(path) as jar:
        found = {name: jar.read(name) for name in jar.namelist() if not OWN.match(name)}
    # jcstress lists tests in the order in which the compiler reads the sources.
    return {name: sorted(content.splitlines()) if name == "META-INF/TestList" else content for name, content in found.items()}


class Gradle(unittest.TestCase):
    first: subprocess.CompletedProcess[str]
    second: subprocess.CompletedProcess[str]

    @classmethod
    def setUpClass(cls) -> None:
        if shutil.which(GRADLE) is None:
            reason = "there is no Gradle on the PATH, nor one that COLLEKTIVE_GRADLE names"
            Path(os.environ["COLLEKTIVE_RESULTS"], "notes").write_text(f"gradle: skipped, {reason}\n")
            raise unittest.SkipTest(reason)
        # The second run reuses the results of the first and its configuration.
        cls.first, cls.second = (gradle("build", "kotlinSourcesJar") for _ in range(2))
        print(cls.first.stdout, cls.second.stdout, sep="\n")

    def test_all_modules_are_built_and_tested(self) -> None:
        self.assertEqual(0, self.first.returncode, self.first.stdout[-4000:])

    def test_a_second_run_reads_the_configuration_cache_and_does_nothing(self) -> None:
        self.assertIn("Configuration cache entry reused.", self.second.stdout)
        self.assertRegex(self.second.stdout, r"(?m)^(\d+) actionable tasks: \1 up-to-date$")

    def test_the_jars_hold_what_mavens_hold(self) -> None:
        modules = [pom.parent for pom in ROOT.glob("jvm-host/*/pom.xml")]
        # Tests write other jars there.
        jars = [jar for module in modules for jar in module.glob("target/*.jar") if re.search(r"^collektive-|-\d", jar.name)]
        self.assertGreaterEqual(len(jars), len(modules))
        different = []
        for jar in jars:
            maven, other = entries(jar), entries(jar.parents[1] / "build" / jar.name)
            different += [f"{jar.name}: {entry}" for entry in sorted(maven.keys() | other.keys()) if maven.get(entry) != other.get(entry)]
        self.assertEqual([], different)
