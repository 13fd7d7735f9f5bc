"""Tests ./collektive run on a project outside the clone, which has its own schema, Kotlin, C# and scenario."""
import csv
import os
import shutil
import subprocess

import pytest
from command import Project, collektive, jdk, last_error

from build import projects


class ProjectTest(Project):
    """Tests runs of the project."""

    def run_it(self, *arguments):
        return collektive("run", "project/lamps.json", "--out", self.path("out"), "--overwrite", *arguments, cwd=self.folder)

    def refused(self, *words, arguments=()):
        """Runs the project, and checks that it fails with a single error that contains all words."""
        result = self.run_it(*arguments)
        self.assertNotEqual(result.returncode, 0)
        for word in words:
            self.assertIn(word, result.stderr)
        return result

    @pytest.mark.quick
    def test_the_project_builds_and_runs(self) -> None:
        result = self.run_it()
        self.assertEqual(result.returncode, 0, result.stderr)
        manifest = self.manifest(self.path("out"))
        # The ten lamps are in a row, so after ten rounds, the brightness of the last one has reached all of them.
        self.assertEqual(manifest["end"], {"agreeing": 10, "seen": 18})
        self.assertEqual(manifest["ticks"], 10)

    @pytest.mark.slow
    def test_edits_behind_links_and_includes_are_detected(self) -> None:
        os.rename(self.path("project", "scene"), self.path("elsewhere"))
        os.symlink(self.path("elsewhere"), self.path("project", "scene"))
        os.makedirs(self.path("project", "programs", "target", ".git"))
        os.rename(self.path("project", "programs", "Brightest.kt"), self.path("project", "programs", "target", ".git", "Brightest.kt"))
        os.rename(self.path("project", "light.fbs"), self.path("light.fbs"))
        os.symlink(self.path("light.fbs"), self.path("project", "linked.fbs"))
        with open(self.path("project", "light.fbs"), "w") as file:
            file.write('include "linked.fbs";\n')
        digests = set()
        for edit in [("programs/target/.git/Brightest.kt", "brightest = best", "brightest = best + 1"),
                     ("scene/Lamps.cs", "Brightness = i + 1", "Brightness = i + 2"),
                     ("linked.fbs", "brightest: float;\n  seen: [int];", "seen: [int];\n  brightest: float;"), None]:
            result = self.run_it()
            self.assertEqual(result.returncode, 0, result.stderr)
            manifest = self.manifest(self.path("out"))
            digests |= {manifest["digest"], *manifest["inputs"].values()}
            if edit:
                self.change(*edit)
        # The set contains the digests of the four runs, and two hashes of each of the three edited parts.
        self.assertEqual(len(digests), 4 + 3 * 2)

    def test_fields_can_be_set_on_the_command_line(self) -> None:
        result = self.run_it("--set", "lamps=6", "--set", "loop=true", "--seed", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        manifest = self.manifest(self.path("out"))
        self.assertEqual(manifest["end"], {"agreeing": 6, "seen": 12})
        self.assertEqual(manifest["scenario"]["seed"], 3)

    def messages(self):
        """Returns the numbers of messages in the whole run."""
        with open(self.path("out", "metrics.csv")) as file:
            rows = list(csv.DictReader(file))
        return {name: sum(int(row[name]) for row in rows) for name in ("sent", "dropped", "delayed", "expired")}

    def test_the_timing_determines_the_ticks_with_rounds(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, "schedule": "Asynchronous", "timing": { "period": 0.5, "phase": 0 }')
        result = self.run_it()
        self.assertEqual(result.returncode, 0, result.stderr)
        # Each lamp runs two rounds in ten ticks, and the lamps have 18 links.
        self.assertEqual(self.messages()["sent"], 2 * 18)
        # The metric must include all lamps, although none was due in the last tick.
        self.assertEqual(self.manifest(self.path("out"))["end"]["seen"], 18)

    def test_the_network_determines_which_messages_arrive(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, "network": { "loss": 1 }')
        result = self.run_it()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.messages(), {"sent": 180, "dropped": 180, "delayed": 0, "expired": 0})
        self.assertEqual(self.manifest(self.path("out"))["end"]["seen"], 0)

    def test_the_profile_counts_ticks_and_names_program_and_function(self) -> None:
        result = collektive("profile", self.path("project", "lamps.json"), "--out", self.path("out"), "--overwrite", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("10 ticks of 10 nodes and 18 links; 0 rounds failed", result.stdout)
        self.assertRegex(result.stdout, r"program brightest \(lamps\.BrightestKt\.\w+\)\n  \d+ rounds sampled \(one in 17\)")
        self.assertIn("allocated, estimated from samples", result.stdout)
        recorded = subprocess.run([os.path.join(jdk(), "bin/jfr"), "summary", self.path("out", "profile.jfr")], capture_output=True, text=True).stdout
        self.assertRegex(recorded, r"(?m)^ collektive\.Tick +10 ")

    @pytest.mark.slow
    def test_the_profile_is_also_printed_if_rounds_failed(self) -> None:
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()",
                    'val mine = sensors.brightness()\n    check(mine != 3f) { "three is too dark" }')
        result = collektive("profile", self.path("project", "lamps.json"), "--out", self.path("out"), "--overwrite", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("10 ticks of 10 nodes and 18 links; 10 rounds failed", result.stdout)

    def test_starts_do_not_wait_for_events_without_a_recording(self) -> None:
        self.change("lamps.json", '"-Xss2m"', '"-Xlog:class+load:file=classes.txt"')
        result = self.run_it("--trust-jvm")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("classes.txt")) as file:
            classes = file.read()
        self.assertIn("org.collektive.host.session.Session ", classes)
        self.assertNotIn("jdk.jfr.internal.", classes)

    @pytest.mark.quick
    def test_kotlin_that_does_not_compile_is_shown_with_file_and_line(self) -> None:
        self.change("programs/Brightest.kt", "sensors.brightness()", "sensors.lightness()")
        self.refused("Brightest.kt:", "lightness")

    @pytest.mark.slow
    def test_compilations_after_the_first_use_its_aot_cache(self) -> None:
        if projects.aot_cache() is None:
            self.skipTest("this JDK has no AOT cache")
        self.change("programs/Brightest.kt", "val mine", f"/* {self.folder} */ val mine")
        self.assertEqual(self.run_it().returncode, 0)
        # With this option, the JVM ends if it cannot use the cache.
        result = subprocess.run([*projects.compiler_jvm(), "-XX:AOTMode=on", "-version"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_paths_that_tools_cannot_read_are_rejected(self) -> None:
        for name, words in [("a\nb", "has a line break or '|', or is not UTF-8"), ("\udcff", "is not UTF-8, which the player and the JVM need"),
                            ("a|b", "has a line break or '|', or is not UTF-8")]:
            os.rename(self.path("project"), self.path(name))
            result = collektive("run", self.path(name, "lamps.json"), "--out", self.path("out"))
            os.rename(self.path(name), self.path("project"))
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, last_error(result))
            self.assertFalse(os.path.exists(self.path("out")))

    def test_csharp_that_does_not_compile_is_shown_with_file_and_line(self) -> None:
        self.change("scene/Lamps.cs", "data.Brightness", "data.Lightness")
        self.refused("Lamps.cs(", "Lightness")

    def test_an_invalid_schema_is_shown_with_file_and_line(self) -> None:
        self.change("light.fbs", "brightness: float;", "brightness: flaot;")
        self.refused("light.fbs", "flaot")

    @pytest.mark.quick
    def test_an_unknown_key_is_reported_with_its_line(self) -> None:
        self.change("lamps.json", '"threads": 2', '"treads": 2')
        self.refused("lamps.json:10", "treads", "threads")

    def test_a_duplicate_key_is_reported(self) -> None:
        self.change("lamps.json", '"threads": 2', '"seconds": 2')
        self.refused("seconds", "twice")

    def test_a_value_of_another_type_is_reported(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": "two"')
        self.refused("threads", "whole number")

    def test_values_out_of_range_are_reported(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 0')
        self.refused("threads", "from 1 to 256")

    def test_a_file_that_is_not_json_is_refused_with_its_line(self) -> None:
        self.change("lamps.json", '"threads": 2,', '"threads": 2')
        self.refused("lamps.json:11", "not valid JSON")

    def test_missing_files_are_reported(self) -> None:
        self.change("lamps.json", "light.fbs", "dark.fbs")
        self.refused("schema", "dark.fbs")

    def test_an_unknown_program_is_reported_with_the_existing_ones(self) -> None:
        self.change("lamps.json", '"brightest"', '"darkest"')
        self.refused("darkest", "brightest")

    def test_an_unknown_scene_is_reported(self) -> None:
        self.change("lamps.json", "Lamps.LampScene", "Lamps.Nonesuch")
        self.refused("Lamps.Nonesuch", "SceneBuilder")

    def test_an_unknown_field_is_reported_with_the_existing_ones(self) -> None:
        self.refused("brightness", "lamps", "loop", arguments=("--set", "brightness=3"))

    def test_a_field_of_another_type_is_reported(self) -> None:
        self.refused("lamps", "whole number", arguments=("--set", "lamps=many"))

    def test_a_missing_scenario_is_reported(self) -> None:
        result = collektive("run", "nowhere.json", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("nowhere.json", last_error(result))

    def test_an_invalid_jvm_is_reported(self) -> None:
        self.change("lamps.json", '"jvm": {', '"jvm": { "location": "Folder", "home": "/nowhere/jdk",')
        self.refused("lamps.json:11", "'jvm.home' is refused", "--trust-jvm")
        self.refused("/nowhere/jdk", arguments=("--trust-jvm",))

    def test_a_jvm_option_that_writes_a_file_needs_trust(self) -> None:
        target = self.path("written.log")
        self.change("lamps.json", '"-Xss2m"', f'"-Xlog:gc*:file={target}"')
        self.refused("lamps.json:11", "'jvm.flags[0]'", "-Xlog:gc*:file=", "--trust-jvm")
        self.assertFalse(os.path.exists(target))
        result = self.run_it("--trust-jvm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(os.path.exists(target))

    def test_an_invalid_jvm_option_is_reported(self) -> None:
        self.change("lamps.json", '"-Xss2m"', '"-Xss2m", "-XX:+UseNonesuchGC"')
        self.refused("UseNonesuchGC")

    def test_a_jvm_setting_out_of_range_is_reported_with_its_line(self) -> None:
        self.change("lamps.json", '"maximumHeapMb": 128', '"maximumHeapMb": 1')
        self.refused("lamps.json:11", "jvm.maximumHeapMb", "16 to")

    def test_an_unknown_jvm_setting_is_reported(self) -> None:
        self.change("lamps.json", '"maximumHeapMb"', '"maximumHeep"')
        self.refused("jvm.maximumHeep", "maximumHeapMb")

    def test_an_invalid_jar_is_reported(self) -> None:
        with open(self.path("project", "broken.jar"), "w") as file:
            file.write("this is no jar")
        self.change("lamps.json", '"programs": "programs"', '"programs": "broken.jar"')
        self.refused("broken.jar")

    def test_a_throwing_program_fails_the_run_after_all_ticks(self) -> None:
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()",
                    'val mine = sensors.brightness()\n    check(mine != 3f) { "three is too dark" }')
        self.refused("three is too dark", "node 2")
        self.assertEqual(self.manifest(self.path("out"))["ticks"], 10)
        self.assertEqual(self.manifest(self.path("out"))["errors"], 10)

    def test_a_schema_that_differs_between_csharp_and_kotlin_is_rejected_with_the_type(self) -> None:
        self.assertEqual(self.run_it().returncode, 0)
        jar = self.programs_jar()
        shutil.copy(jar, self.path("project", "old.jar"))
        self.change("lamps.json", '"programs": "programs"', '"programs": "old.jar"')
        self.change("light.fbs", "seen: [int];", "seen: [int];\n  colour: int;")
        self.refused("ActuatorData")
