"""Tests replaying and comparing recorded runs."""
import os
import shutil
import struct
import subprocess
import unittest.mock
import zlib

import pytest
from command import Project, collektive, last_error

from build.places import COLLEKTIVE, ROOT


def with_another_jar(record):
    """Returns the record with a different date on the first entry of its jar, as if the jar were compiled on another machine."""
    at, data = record.index(b"PK\3\4"), bytearray(record)
    data[at + 10] ^= 1
    # As docs/record-format.md describes, 8 bytes precede the chunks, and a chunk consists of kind, length, checksum and payload.
    chunk = 8
    while True:
        length, = struct.unpack_from("<I", data, chunk + 4)
        if at < chunk + 12 + length:
            checksum = zlib.crc32(data[chunk + 12:chunk + 12 + length], zlib.crc32(data[chunk:chunk + 8]))
            struct.pack_into("<I", data, chunk + 8, checksum)
            return bytes(data)
        chunk += 12 + length


class Records(Project):
    """Tests with recorded runs of the project."""

    def setUp(self) -> None:
        super().setUp()
        self.change("lamps.json", '"metrics": true', '"metrics": true, "record": true')
        self.a = self.record("a")

    def record(self, name, *arguments):
        result = collektive("run", self.path("project", "lamps.json"), "--out", self.path(name), "--overwrite", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.path(name, "run.clkrec")

    @pytest.mark.quick
    def test_a_replay_verifies_all_digests_without_unity_or_the_jar(self) -> None:
        result = collektive("replay", self.a)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("10 ticks replayed, all digests equal the record", result.stdout)
        self.assertIn(self.manifest(self.path("a"))["digest"], result.stdout)
        self.assertIn(next(iter(self.manifest(self.path("a"))["programs"].values())), result.stdout)

    def test_a_replay_with_a_changed_program_reports_the_first_difference(self) -> None:
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()", "val mine = if (sensors.brightness() == 5f) 9f else sensors.brightness()")
        self.record("b")
        jar = self.programs_jar()
        result = collektive("replay", self.a, "--programs", jar)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stdout, r"tick \d+ is the first difference.*node \d+, actuators\.brightest: \S+ in the record, 9.0 in the replay")

    @pytest.mark.slow
    def test_a_replay_has_the_same_maths_as_its_run(self) -> None:
        maths = "(0..3000).fold(0L) { sum, i -> 31 * sum + kotlin.math.tanh(i * 0.037).toRawBits() + kotlin.math.sin(i * 0.037).toRawBits() } % 1000"
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()", f"val mine = sensors.brightness() + {maths}")
        self.change("lamps.json", '"maximumHeapMb": 128', '"repeatableMaths": true')
        result = collektive("replay", self.record("b"))
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_a_replay_ignores_the_user_s_jvm_options_like_its_run(self) -> None:
        letter = '"I".lowercase(java.util.Locale.getDefault())[0].code'
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()", f"val mine = sensors.brightness() + {letter}")
        record = self.record("b")
        with unittest.mock.patch.dict(os.environ, JAVA_TOOL_OPTIONS="-Duser.language=tr"):
            result = collektive("replay", record)
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)

    def test_a_replay_overwrites_neither_its_record_nor_other_files(self) -> None:
        with open(self.a, "rb") as file:
            before = file.read()
        os.link(self.a, self.path("link.clkrec"))
        os.symlink(self.a, self.path("symlink.clkrec"))
        shutil.copy(self.a, self.path("kept.clkrec"))
        os.link(self.path("kept.clkrec"), self.path("name.clkrec"))
        scenario, b = self.path("project", "lamps.json"), self.record("b")
        for out, message in ((self.a, "is the record that is read"), (self.path("link.clkrec"), "is the record that is read"),
                             (self.path("symlink.clkrec"), "is the record that is read"), (self.path("name.clkrec"), "is a hard link"),
                             (scenario, "exists and was not written by --out"), (b, "is reserved for the record")):
            result = collektive("replay", self.a, "--out", out)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(message, last_error(result))
        result = collektive("run", scenario, "--out", self.path("other"), "--recording", scenario)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("exists and was not written by --recording", last_error(result))
        result = collektive("run", scenario, "--out", self.path("other"), "--recording", self.path("other", "metrics.csv"))
        self.assertIn("the name must end in .jfr", last_error(result))
        with open(self.a, "rb") as file:
            self.assertEqual(file.read(), before)
        with open(scenario, "rb") as file:
            self.assertTrue(file.read().lstrip().startswith(b"{"))
        for _ in range(2):
            self.assertEqual(collektive("replay", self.a, "--out", self.path("again.clkrec")).returncode, 0)

    def test_two_runs_are_compared(self) -> None:
        self.assertEqual(collektive("diff", self.a, self.record("b")).returncode, 0)
        result = collektive("diff", self.a, self.record("c", "--set", "lamps=9"))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("tick 1: input of node 9, nodesAdded: present in A, absent in B", result.stdout)

    def test_programs_that_never_ran_here_are_replayed_only_with_trust(self) -> None:
        elsewhere = self.path("elsewhere.clkrec")
        with open(self.a, "rb") as file:
            data = file.read()
        # The record is the same except for its jar, in which an entry has a different date. The name and the length of the jar stay the same.
        with open(elsewhere, "wb") as file:
            file.write(with_another_jar(data))
        result = collektive("replay", elsewhere)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("contains programs that have never run here", last_error(result))
        self.assertIn("--trust", last_error(result))
        self.assertNotIn("ticks replayed", result.stdout)
        result = collektive("replay", elsewhere, "--trust")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("10 ticks replayed", result.stdout)
        result = collektive("replay", elsewhere, "--programs", self.programs_jar())
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_damaged_record_is_replayed_up_to_the_reported_position(self) -> None:
        with open(self.a, "rb") as file:
            data = file.read()
        with open(self.a, "wb") as file:
            file.write(data[:-100])
        result = collektive("replay", self.a)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(last_error(result), r"damaged at byte \d+, after tick 9")
        self.assertIn("9 ticks replayed, all digests equal the record", result.stdout)

    def test_a_file_that_is_not_a_record_is_rejected(self) -> None:
        for arguments in [("replay", self.path("nowhere")), ("replay", os.path.join(ROOT, "README.md")), ("diff", self.a), ("replay",),
                          ("replay", self.a, "--programs", "/dev/zero"), ("diff", self.a, "\udcff")]:
            result = collektive(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertTrue(last_error(result).startswith("collektive: "), arguments)

    def test_a_jvm_that_does_not_start_is_not_a_difference(self) -> None:
        for arguments in [("replay", self.a), ("diff", self.a, self.a)]:
            result = subprocess.run(["bash", "-c", 'ulimit -v 2000000; exec "$@"', "bash", COLLEKTIVE, *arguments], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(f"collektive: {arguments[0]}: the JVM has ended; its messages are above", result.stderr)
