"""Tests a project that ./collektive new creates."""
import os

from command import Folder, collektive, last_error


class NewTest(Folder):
    def test_a_new_project_passes_its_tests_and_its_scenario_and_experiment_run(self) -> None:
        created = collektive("new", "herd", cwd=self.folder)
        self.assertEqual(created.returncode, 0, created.stderr)
        self.assertEqual(os.listdir(self.folder), ["herd"])
        self.assertEqual(sorted(os.listdir(self.path("herd"))), ["experiment.json", "herd.fbs", "programs", "scenario.json", "scene", "tests"])
        checked = collektive("check", "herd", cwd=self.folder)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("24 runs", checked.stdout)
        tested = collektive("test", "herd", cwd=self.folder)
        self.assertEqual((tested.returncode, tested.stdout.splitlines()[-1]), (0, "1 passed, 0 failed"), tested.stderr)
        ran = collektive("run", "herd/scenario.json", "--out", "out", cwd=self.folder)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        manifest = self.manifest(self.path("out"))
        self.assertEqual((manifest["nodes"], manifest["errors"]), (100, 0))
        self.assertGreater(manifest["end"]["reached"], 0.5)
        self.assertTrue(os.path.exists(self.path("out", "replay.html")))

    def test_an_existing_folder_is_kept_and_invalid_names_are_refused(self) -> None:
        os.mkdir(self.path("herd"))
        for name, message in (("herd", "'herd' already exists"), ("Herd", "must consist of lower-case letters"), ("../up", "must consist of"),
                              ("class", "'class' is a reserved word")):
            result = collektive("new", name, cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(message, last_error(result))
        self.assertEqual(os.listdir(self.path("herd")), [])
