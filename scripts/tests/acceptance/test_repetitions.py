"""Tests repeating a run from its manifest."""
import json
import os

import pytest
from command import Project, collektive, last_error


class Repetitions(Project):
    """Tests ./collektive repeat, which repeats a run from its manifest."""

    def setUp(self) -> None:
        super().setUp()
        self.change("lamps.json", '"threads": 2', '"threads": 2, "schedule": "Asynchronous", "timing": { "period": 0.25 }, "network": { "loss": 0.25 }')
        result = collektive("run", self.path("project", "lamps.json"), "--out", self.path("a"), "--set", "lamps=12", "--seed", str(2**64 - 1), "--seconds", "3")
        self.assertEqual(result.returncode, 0, result.stderr)

    def repeat(self, *arguments):
        return collektive("repeat", self.path("a", "manifest.json"), "--out", self.path("b"), "--overwrite", *arguments)

    def test_a_run_is_repeated_without_its_scenario_file(self) -> None:
        os.remove(self.path("project", "lamps.json"))
        result = self.repeat()
        self.assertEqual(result.returncode, 0, result.stderr)
        first, second = self.manifest(self.path("a")), self.manifest(self.path("b"))
        self.assertIn(f"repeated: 30 ticks, digest {first['digest']}", result.stdout)
        self.assertNotIn("changed since the run", result.stderr)
        for key in ["scenario", "file", "folder", "inputs", "programs", "parameters", "ticks", "digest", "end"]:
            self.assertEqual(first[key], second[key], key)
        self.assertEqual(first["scenario"]["seed"], 2**64 - 1)
        self.assertEqual(first["scenario"]["fields"], {"lamps": 12, "loop": False})
        self.assertEqual(first["scenario"]["jvm"]["flags"], ["-Xss2m"])

    def test_changed_inputs_and_different_results_are_reported(self) -> None:
        self.change("scene/Lamps.cs", "Brightness = i + 1", "Brightness = i + 2")
        result = self.repeat()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, "changed since the run of .*: scripts is ")
        self.assertNotRegex(result.stderr, "changed since the run of .*: (schema|programs) is ")
        self.assertRegex(last_error(result), "the run differs from the one in .*: digest is [0-9a-f]{16}, previously [0-9a-f]{16}")

    def test_all_results_are_compared(self) -> None:
        file = self.path("a", "manifest.json")
        with open(file, encoding="utf-8") as stream:
            manifest = json.load(stream)
        edited = {"nodes": 13, "errors": 1, "start": {}, "converged": {"lit": 1.5}}
        with open(file, "w", encoding="utf-8") as stream:
            json.dump({**manifest, **edited}, stream)
        result = self.repeat()
        self.assertEqual(result.returncode, 1)
        for key in edited:
            self.assertRegex(last_error(result), f"{key} is .*, previously ")
        del manifest["errors"]
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(manifest, stream)
        self.assertIn("the key 'errors' is missing", last_error(self.repeat()))

    @pytest.mark.slow
    def test_a_moved_project_is_found_with_the_folder_option(self) -> None:
        os.rename(self.path("project"), self.path("moved"))
        result = self.repeat()
        self.assertEqual(result.returncode, 1)
        self.assertIn("--folder", last_error(result))
        self.assertEqual(self.repeat("--folder", self.path("moved")).returncode, 0)

    def test_a_file_that_is_not_a_manifest_is_rejected(self) -> None:
        for path, word in [(self.path("nowhere.json"), "does not exist"), (self.path("project"), "is not a file: name the manifest.json"),
                           (self.path("project", "lamps.json"), "is not the manifest of a run")]:
            result = collektive("repeat", path)
            self.assertEqual(result.returncode, 1)
            self.assertIn(word, last_error(result))
