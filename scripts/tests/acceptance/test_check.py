"""Tests ./collektive check, which checks scenarios and experiments before they are run."""
import json
import os
import re

import pytest
from command import Project, collektive


class CheckTest(Project):
    def write(self, name: str, **values: object) -> str:
        """Writes a copy of the project's scenario in which some values are replaced, and returns its path."""
        with open(self.path("project", "lamps.json")) as file:
            scenario = json.load(file)
        path = self.path("project", name)
        with open(path, "w") as file:
            json.dump({**scenario, **values}, file, indent=1)
        return path

    def test_all_scenarios_and_experiments_of_a_folder_are_checked(self) -> None:
        with open(self.path("project", "sweep.json"), "w") as file:
            json.dump({"version": 1, "scenario": "lamps.json", "vary": {"fields.lamps": [5, 7], "seed": "1-2"}}, file)
        with open(self.write("plain.json")) as file:
            text = re.sub('"(\\w+)":', r"\1:", file.read())
        with open(self.path("project", "plain.json"), "w") as file:
            file.write(text)
        before = sorted(os.listdir(self.path("project")))
        result = collektive("check", "project", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("4 runs into", result.stdout)
        self.assertIn("project/lamps.json: valid scenario\nproject/plain.json: valid scenario\nproject/sweep.json: valid experiment\n", result.stdout)
        self.assertEqual(sorted(os.listdir(self.path("project"))), before)

    @pytest.mark.slow
    def test_each_invalid_file_has_an_error_and_the_others_are_checked(self) -> None:
        with open(self.path("project", "sweep.json"), "w") as file:
            json.dump({"version": 1, "scenario": "lamps.json", "vary": {"fields.lmps": [5]}}, file)
        errors = {
            self.write("key.json", secnds=3): "unknown key 'secnds'",
            self.write("program.json", program="brightst"): "unknown program 'brightst'",
            self.write("parameter.json", parameters={"brightest": {"step": 3}}): "'parameters.brightest.step': unknown parameter; the program declares: ",
            self.write("metric.json", metrics={"lit": "avg(lihgt)"}): "no such column: lihgt",
            self.write("function.json", metrics={"lit": {"function": "lit"}}): "unknown metric 'lit'; the jars contain no metrics",
            self.write("no-function.json", metrics={"lit": {}}): "'metrics.lit.function' is missing",
            self.path("project", "sweep.json"): "no public field 'lmps'",
            self.path("project", "nowhere.json"): "is not a file",
        }
        valid = self.path("project", "lamps.json")
        result = collektive("check", *errors, valid)
        self.assertEqual(result.returncode, 1, result.stderr)
        for path, error in errors.items():
            self.assertEqual(result.stderr.count(error), 1, result.stderr)
            self.assertRegex(result.stdout, f"(?m)^{path}: invalid (scenario|experiment)$")
        self.assertIn(f"{valid}: valid scenario", result.stdout)

    def test_a_folder_without_files_to_check_is_an_error(self) -> None:
        os.mkdir(self.path("empty"))
        result = collektive("check", self.path("empty"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("contains no scenarios or experiments", result.stderr)
