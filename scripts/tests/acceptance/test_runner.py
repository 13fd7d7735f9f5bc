"""Tests the runner of the C# tests."""
import os
import subprocess
import textwrap
import unittest
from pathlib import Path

import pytest
from command import Folder

from build import csharp
from build.places import BUILD

RUNNER = os.path.join(BUILD, "csharp/Collektive.TestRunner.exe")


@unittest.skipUnless(os.path.exists(RUNNER), "this system has no package for NUnit")
class TestRunnerTest(Folder):
    def run_fixture(self, test, *options):
        """Compiles and runs a fixture with a passing test and the given test. Returns the exit code, the last line and the whole output."""
        source = """
            using NUnit.Framework;

            public sealed class Fixture
            {
                [Test]
                public void Passes() { }

                TEST
            }
            """
        with open(self.path("Fixture.cs"), "w") as file:
            file.write(textwrap.dedent(source).replace("TEST", test))
        nunit = os.path.join(BUILD, "csharp/nunit.framework.dll")
        csharp.compile_assembly(Path(self.path("Fixture.dll")), [Path(self.path("Fixture.cs"))], ["-r:" + nunit])
        result = subprocess.run(["mono-sgen", RUNNER, *options, self.path("Fixture.dll")], capture_output=True, text=True,
                                env={"PATH": os.environ["PATH"], "MONO_PATH": os.path.dirname(RUNNER)})
        return result.returncode, result.stdout.splitlines()[-1], result.stdout

    def test_a_failing_test_fails_the_run(self) -> None:
        code, verdict, _ = self.run_fixture('[Test] public void Fails() => Assert.Fail("no");')
        self.assertEqual((code, verdict), (1, "1 passed, 1 failed"))

    def test_an_unsupported_attribute_is_a_failure(self) -> None:
        code, verdict, output = self.run_fixture('[Theory] public void Fails() => Assert.Fail("no");')
        self.assertEqual((code, verdict), (1, "1 passed, 1 failed"))
        self.assertIn("Fixture.Fails: this runner does not support [TheoryAttribute]", output)

    @pytest.mark.slow
    def test_a_category_can_be_skipped(self) -> None:
        test = '[Test, Category("Slow")] public void Fails() => Assert.Fail("no");'
        code, verdict, output = self.run_fixture(test, "--without", "Other", "--without", "Slow")
        self.assertEqual((code, verdict), (0, "1 passed, 0 failed"))
        self.assertIn("1 tests of category Slow were skipped", output)
        self.assertEqual(self.run_fixture(test)[:2], (1, "1 passed, 1 failed"))
