"""Runs the Kotlin tests of a project."""
import os
import shutil

import pytest
from command import Project, collektive

TESTS = """package lamps

import org.collektive.testing.TestNetwork
import org.junit.jupiter.api.Test
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import kotlin.test.assertEquals

class Lamps {
    @Test
    fun `hops count links`() = TestNetwork().use { network ->
        network.add(0, 1)
        network.link(0, 1)
        assertEquals(mapOf(0 to 0, 1 to 1), network.rounds(2) { hopDistanceTo(localId == 0) })
    }

    @Test
    fun `one is two`() = assertEquals(1, 2)
}
"""


class ProjectTestsTest(Project):
    @pytest.mark.slow
    def test_tests_run_beside_the_programs(self) -> None:
        result = collektive("test", "project", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("has no Kotlin tests: add tests to it", result.stderr)
        os.mkdir(self.path("project", "tests"))
        file = self.path("project", "tests", "LampsTest.kt")
        for text, code, line in ((TESTS, 1, "1 passed, 1 failed"), (TESTS.replace("(1, 2)", "(2, 2)"), 0, "2 passed, 0 failed"),
                                 # The JVM disables assertions by default.
                                 (TESTS.replace("assertEquals(1, 2)", "assert(1 > 2)"), 1, "1 passed, 1 failed"),
                                 # JUnit does not run tests that return a value.
                                 (TESTS.replace("assertEquals(1, 2)", "1"), 1, "0 passed, 1 failed"), ("fun wrong(", 1, None)):
            with open(file, "w") as output:
                output.write(text)
            result = collektive("test", "project", cwd=self.folder)
            self.assertEqual(result.returncode, code, result.stderr)
            if line is not None:
                self.assertEqual(result.stdout.splitlines()[-1], line)
            else:
                self.assertIn("LampsTest.kt:1", result.stderr)

    @pytest.mark.slow
    def test_each_failure_counts(self) -> None:
        tests = self.path("project", "tests")
        os.mkdir(tests)
        others = []
        for text in (TESTS.replace("(1, 2)", "(2, 2)"), TESTS.replace("assertEquals(1, 2)", "System.exit(0)"), TESTS):
            with open(os.path.join(tests, "LampsTest.kt"), "w") as output:
                output.write(text)
            if text != TESTS:
                others.append(shutil.copytree(self.path("project"), self.path(str(len(others)), "project")))
        # A later project of the same name must not replace the results, and a test that ends the process has none.
        result = collektive("test", "project", *others, cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout.splitlines()[-1], "3 passed, 2 failed")
