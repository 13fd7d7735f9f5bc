"""The Gradle build makes what Maven's makes, and does nothing twice."""
import os
import re
import shutil
import subprocess
import unittest
import zipfile
from pathlib import Path

from build.places import ROOT

GRADLE = os.environ.get("COLLEKTIVE_GRADLE", "gradle")
# The jars by the module that makes them.
JARS = {"host": ["host", "library", "adapter"], "generator": ["generator"], "tools": ["tools"], "testing": ["testing"], "programs": ["programs"],
        "bench": ["bench"]}
# What each build says of itself.
OWN = re.compile(r"META-INF/(MANIFEST\.MF|maven/.*)$")


def gradle(*tasks):
    return subprocess.run([GRADLE, "--no-daemon", "--console=plain", *tasks],
                          cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def entries(*path):
    with zipfile.ZipFile(os.path.join(ROOT, "jvm-host", *path)) as jar:
        found = {name: jar.read(name) for name in jar.namelist() if not name.endswith("/") and not OWN.match(name)}
    # Maven ends lists of services with a line feed, Shadow does not.
    return {name: read.split() if name.startswith("META-INF/services/") else read for name, read in found.items()}


class Gradle(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        if shutil.which(GRADLE) is None:
            reason = "there is no Gradle on the PATH, nor one that COLLEKTIVE_GRADLE names"
            Path(os.environ["COLLEKTIVE_RESULTS"], "notes").write_text(f"gradle: skipped, {reason}\n")
            raise unittest.SkipTest(reason)
        # The second run finds all done, and the build's own model in the configuration cache.
        cls.first, cls.second = (gradle("build", "kotlinSourcesJar") for _ in range(2))
        print(cls.first.stdout, cls.second.stdout, sep="\n")

    def test_all_modules_are_built_and_tested(self) -> None:
        self.assertEqual(0, self.first.returncode, self.first.stdout[-4000:])

    def test_a_second_run_reads_the_configuration_cache_and_does_nothing(self) -> None:
        self.assertIn("Configuration cache entry reused.", self.second.stdout)
        self.assertRegex(self.second.stdout, r"(?m)^(\d+) actionable tasks: \1 up-to-date$")

    def test_the_jars_hold_what_mavens_hold(self) -> None:
        different = []
        for module, name in ((module, name) for module, names in JARS.items() for name in names):
            jar = f"collektive-{name}.jar"
            maven, other = entries(module, "target", jar), entries(module, "build/libs", jar)
            different += [f"{jar}: {entry}" for entry in sorted(maven.keys() | other.keys()) if maven.get(entry) != other.get(entry)]
        self.assertEqual([], different)
