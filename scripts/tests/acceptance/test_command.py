"""Tests the errors about unknown and invalid commands and options."""
import tempfile
import unittest
from pathlib import Path

import pytest
from command import Folder, collektive, last_error

from build.places import ROOT


@pytest.mark.quick
class CommandTest(unittest.TestCase):
    def test_each_command_has_help(self) -> None:
        whole = collektive("--help")
        self.assertEqual(whole.returncode, 0)
        commands = ["setup", "generate", "demo", "run", "repeat", "sweep", "plot", "profile", "replay", "diff", "test", "bench", "package", "site", "clean"]
        for command in commands:
            self.assertIn(command, whole.stdout)
            part = collektive(command, "--help")
            self.assertEqual(part.returncode, 0, command)
            self.assertTrue(part.stdout.strip(), command)

    def test_unknown_commands_and_options_are_reported(self) -> None:
        self.assertEqual(collektive("nonesuch").returncode, 2)
        result = collektive("demo", "--nonesuch")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--nonesuch", last_error(result))

    def test_a_site_does_not_replace_another_folder(self) -> None:
        with tempfile.TemporaryDirectory() as other:
            Path(other, "sitemap.xml").touch()
            for folder in (str(ROOT), other):
                result = collektive("site", "--out", folder)
                self.assertEqual(result.returncode, 1)
                self.assertIn(f"'{folder}' exists and is not a site built by this command", last_error(result))
            self.assertTrue(Path(other, "sitemap.xml").exists())
            # A clone of the branch with a published site contains its marker.
            Path(other, ".collektive-site").touch()
            Path(other, ".git").mkdir()
            result = collektive("site", "--out", other)
            self.assertEqual(result.returncode, 1)
            self.assertIn("is a Git working tree", last_error(result))
            self.assertTrue(Path(other, ".git").exists())


class TestCommandTest(unittest.TestCase):
    def test_an_unknown_fault_is_reported(self) -> None:
        result = collektive("test", "--faults", "no", "such fault")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'no such fault'", last_error(result))

    def test_extra_arguments_are_rejected(self) -> None:
        for option in ["--exits", "--sanitize"]:
            result = collektive("test", option, "x")
            self.assertEqual(result.returncode, 1)
            self.assertIn(option, last_error(result))


@pytest.mark.quick
class InvalidDemoOptionsTest(Folder):
    def test_invalid_numbers_are_rejected_and_earlier_results_are_kept(self) -> None:
        manifest = Path(self.path("out", "manifest.json"))
        manifest.parent.mkdir()
        manifest.write_text('{"outcome": "complete"}')
        for arguments, word in [(["--nodes", "0"], "0 nodes"), (["--nodes", "20000"], "too small for 20000"), (["--nodes", "many"], "--nodes"),
                                (["--seconds", "-1"], "--seconds"), (["--seed", "1.5"], "--seed")]:
            result = collektive("demo", *arguments, "--out", self.path("out"), "--overwrite")
            self.assertEqual(result.returncode, 1, arguments)
            self.assertIn(word, last_error(result))
            self.assertEqual(manifest.read_text(), '{"outcome": "complete"}')
