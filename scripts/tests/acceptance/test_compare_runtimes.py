"""Tests ./collektive compare-runtimes, which compares functions on two runtimes and reduces a difference to a small run."""
import os
import re
from unittest import mock

import pytest
from command import Folder, collektive

IMPORTS = """package compared

import it.unibo.collektive.aggregate.*
import it.unibo.collektive.aggregate.api.*
import it.unibo.collektive.stdlib.collapse.*
import it.unibo.collektive.stdlib.spreading.*
import org.collektive.api.Device
import org.collektive.links.distances

"""
PORTABLE = IMPORTS + """
fun Aggregate<Int>.passedOn(): Int = exchanging(if (localId == 0) 1 else 0) { f ->
    val next = f.neighbors.ids.list.minOrNull()
    mapNeighborhood { id -> if (id == next) f.all.values.sum() else 0 }.yielding { f.all.values.sum() }
}
fun Aggregate<Int>.each(device: Device): Any? = exchanging(device.id) { f ->
    f.map { (id, value) -> (value * 31 + id) % 997 }.yielding { f.all.toMap().toSortedMap() }
}
context(device: Device) fun Aggregate<Int>.reached(): Double = distanceTo(device.random.nextInt(4) == 0, metric = distances())
fun Aggregate<Int>.fails(): Int = if (localId == 1) error("always") else neighboring(localId).neighbors.size
fun plain(x: Int): Int = x
"""
# The function returns the name of the class that implements Aggregate, which differs between the runtimes.
DIFFERENT = IMPORTS + """
fun Aggregate<Int>.different(): String {
    val rounds = evolve(0) { it + 1 }
    val near = neighboring(localId).neighbors.size
    return if (rounds >= 3 && near >= 2) this.javaClass.simpleName else "$near"
}
"""


class Compared(Folder):
    def compare(self, text, *options):
        with open(self.path("Compared.kt"), "w", encoding="utf-8") as file:
            file.write(text)
        return collektive("compare-runtimes", self.path("Compared.kt"), *options)

    @pytest.mark.slow
    def test_all_functions_of_a_file_are_compared(self) -> None:
        result = self.compare(PORTABLE, "--runs", "12")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertEqual([line.split(":")[0] for line in result.stdout.splitlines()], ["each", "fails", "passedOn", "reached"])

    @pytest.mark.slow
    def test_a_difference_is_reduced_to_the_smallest_network_and_shortest_run(self) -> None:
        if os.environ.get("COLLEKTIVE_JARS"):
            pytest.skip("the test expects this project's classes, not those of Collektive's jars")
        result = self.compare(DIFFERENT)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        first, *ticks, last = result.stdout.splitlines()
        self.assertIn("the smallest run has 3 nodes and 3 ticks", first)
        self.assertEqual(len(ticks), 3)
        self.assertRegex(last, r'tick 3, node \d+: "AggregateDevice" on the built-in runtime, "MailboxRound" on the mailbox runtime')
        self.assertTrue(re.fullmatch(r"  tick 3: nodes (\d+) (\d+) (\d+); links \d+-\d+ \d+-\d+; rounds of \d+", ticks[2]), ticks[2])

    @pytest.mark.slow
    def test_differences_in_texts_are_found_in_any_locale(self) -> None:
        functions = """
fun Aggregate<Int>.`ein Maß`(): String = "\\r\\r" + if ("Mailbox" in "$this") "ä" else "ö"
fun Aggregate<Int>.nothing(): String? = if ("Mailbox" in "$this") "null" else null
fun Aggregate<Int>.number(): String = if ("Mailbox" in "$this") "1.10" else "1.1"
"""
        with mock.patch.dict(os.environ, LC_ALL="C"):
            result = self.compare('@file:JvmName("Renamed")\n' + IMPORTS + functions, "--runs", "1")
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        answers = re.findall(r"node \d+: (.*) on the built-in runtime, (.*) on", result.stdout)
        self.assertEqual(answers, [(r'"\r\rö"', r'"\r\rä"'), ("null", '"null"'), ('"1.1"', '"1.10"')], result.stdout)

    @pytest.mark.slow
    def test_files_without_functions_are_refused(self) -> None:
        result = self.compare(IMPORTS)
        self.assertEqual(result.returncode, 2)
        self.assertIn("has no public function", result.stderr)
        unknown = self.compare(PORTABLE, "--function", "each", "--function", "eahc")
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("Aggregate<Int>.eahc()`", unknown.stderr)
        self.assertIn("it has each, fails, passedOn, reached", unknown.stderr)
        repeated = self.compare(PORTABLE + "fun Aggregate<Int>.each(): Int = localId\n")
        self.assertEqual(repeated.returncode, 2)
        self.assertIn("has several functions 'each'", repeated.stderr)
        with mock.patch.dict(os.environ, COLLEKTIVE_JARS=self.path("nowhere")):
            jars = self.compare(PORTABLE)
        self.assertEqual(jars.returncode, 2)
        self.assertIn("which contains no jars", jars.stderr)
        missing = collektive("compare-runtimes", self.path("nowhere"))
        self.assertEqual(missing.returncode, 2)
        self.assertIn("does not exist", missing.stderr)
        os.mkfifo(self.path("pipe"))
        pipe = collektive("compare-runtimes", self.path("pipe"))
        self.assertEqual(pipe.returncode, 2)
        self.assertIn("is not a file or folder", pipe.stderr)

    def test_collektive_gives_the_same_answers(self) -> None:
        if not os.environ.get("COLLEKTIVE_JARS"):
            pytest.skip("COLLEKTIVE_JARS is not set: name the folder of Collektive's jars to compare with Collektive")
        result = self.compare(PORTABLE, "--runs", "60")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
