"""Tests the messages about invalid input and invalid environments."""
import os
import subprocess
import sys

import pytest
from command import Project, collektive, last_error

from build.places import COLLEKTIVE, ROOT


class Messages(Project):
    def run_it(self, *arguments, out="out", **options):
        return subprocess.run([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path(out), "--overwrite", *arguments],
                              capture_output=True, text=True, timeout=200, **options)

    def in_program(self, line) -> None:
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()", f"val mine = sensors.brightness()\n    {line}")

    def test_a_kotlin_error_is_printed_first_without_warnings(self) -> None:
        self.change("programs/Brightest.kt", "sensors.brightness()", "sensors.lightness()")
        result = self.run_it(cwd=self.folder)
        lines = [line for line in result.stderr.splitlines() if not line.startswith("[")]
        self.assertRegex(lines[0], r"project/programs/Brightest\.kt:10:24: error: ")
        self.assertNotIn("WARNING", result.stderr)
        log = last_error(result).rsplit(" ", 1)[1]
        self.assertTrue(os.path.isfile(log), log)

    def test_a_run_without_nodes_fails(self) -> None:
        result = self.run_it("--set", "lamps=0")
        self.assertEqual(result.returncode, 1)
        self.assertIn("the run had no nodes: create GameObjects with the component Node in the scene builder", last_error(result))
        self.assertEqual(self.manifest(self.path("out"))["outcome"], "the run had no nodes")

    @pytest.mark.slow
    def test_programs_without_a_runtime_mark_are_rejected_with_the_solution(self) -> None:
        self.change("programs/Brightest.kt", '@Program("brightest")', "")
        self.assertIn('the jars contain no programs: annotate the function with @Program("brightest")', last_error(self.run_it()))

    def test_a_schema_error_begins_with_its_position(self) -> None:
        self.change("light.fbs", "brightness: float;", "brightness: flaot;")
        place = self.path("project", "light.fbs")
        self.assertRegex(self.run_it().stderr, rf"(?m)^{place}:7: error: type referenced but not defined .*flaot")

    @pytest.mark.slow
    def test_a_tick_in_which_all_rounds_fail_ends_the_run_unless_keep_going(self) -> None:
        self.in_program("if (mine == 3f) { val all = generateSequence { LongArray(1 shl 20) }.toList() }\n    if (mine == 4f) listOf(1).map { check(it > 2) }\n"
                        '    check(mine < 0) { "always" }')
        result = self.run_it()
        self.assertEqual(result.returncode, 1)
        self.assertIn("stopped at tick 1: all rounds failed; the errors are above. To continue anyway, use --keep-going", last_error(result))
        self.assertIn("failed: stopped at tick 1", self.manifest(self.path("out"))["outcome"])
        # The message about a full heap must name the setting, and an error in inlined code must have the line of the call.
        output = result.stderr + result.stdout
        self.assertRegex(output, r"Java heap space, with all 12\d MB in use: raise the maximum heap in the JVM settings \(jvm\.maximumHeapMb\)")
        self.assertRegex(output, r"IllegalStateException.*\n    at lamps\.BrightestKt\.brightest\(Brightest\.kt:12\)")
        result = self.run_it("--keep-going")
        self.assertEqual(result.returncode, 1)
        self.assertEqual((self.manifest(self.path("out"))["ticks"], self.manifest(self.path("out"))["errors"]), (10, 100))

    def test_settings_of_the_wrong_form_are_rejected(self) -> None:
        for value in ["0", "Lockstep,Sequential", "2", ""]:
            with self.subTest(value):
                self.change("lamps.json", '"threads": 2', f'"threads": 2, "schedule": "{value}"')
                self.assertRegex(last_error(self.run_it()), r"'schedule' is .*one of Lockstep, Sequential, Asynchronous")
                self.change("lamps.json", f'"threads": 2, "schedule": "{value}"', '"threads": 2')
        self.change("lamps.json", '["-Xss2m"]', '"-Xss2m"')
        self.assertIn("it must be of type list of strings", last_error(self.run_it()))

    def test_pipes_and_huge_folders_are_rejected_immediately(self) -> None:
        os.mkfifo(self.path("pipe"))
        result = subprocess.run([COLLEKTIVE, "run", self.path("pipe")], capture_output=True, text=True, timeout=60)
        self.assertIn("pipe' is not a file", last_error(result))
        self.change("lamps.json", '"light.fbs"', '"../pipe"')
        self.assertIn("'schema' does not name a file", last_error(self.run_it()))
        self.change("lamps.json", '"../pipe"', '"light.fbs"')
        self.change("lamps.json", '"scripts": "scene"', '"scripts": "/usr"')
        self.assertIn("the folder '/usr' has more than 10,000 files", last_error(self.run_it()))

    def test_control_characters_are_escaped(self) -> None:
        for command in ("run", "repeat", "\x1b[2J"):
            result = collektive(command, self.path("a\x1b[2J\x9b"))
            self.assertIn("\\x1b[2J", result.stderr)
            self.assertNotRegex(result.stderr, "[\x1b\x9b]")

    def test_folder_names_can_contain_any_characters_in_any_locale(self) -> None:
        odd = self.path("ünïcödé 雪 \"quo'te")
        os.rename(self.path("project"), odd)
        os.symlink(odd, self.path("project"))
        result = subprocess.run([COLLEKTIVE, "run", os.path.join(odd, "lamps.json"), "--out", self.path("out 雪")], capture_output=True,
                                text=True, env={**os.environ, "LANG": "C", "LC_ALL": "C"})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.manifest(self.path("out 雪"))["folder"], odd)

    def test_invalid_arguments_of_live_are_reported_once(self) -> None:
        scenario = self.path("project", "lamps.json")
        for words, message in ((["nowhere.json"], "nowhere.json' is not a file"),
                               ([scenario, "--port", "99999"], "'99999' is not a port from 0 to 65535")):
            result = collektive("live", *words, "--no-browser")
            self.assertEqual((result.returncode, result.stdout), (1, ""))
            self.assertEqual([message in line for line in result.stderr.splitlines() if line.startswith("collektive: ")], [True])

    def test_unusual_shell_environments_work_or_are_reported(self) -> None:
        small = subprocess.run(["bash", "-c", f"ulimit -s 64; {COLLEKTIVE} run {self.path('project', 'lamps.json')}"], capture_output=True, text=True)
        self.assertEqual(small.returncode, 1)
        self.assertIn("the stack limit is 64 KB, and the tools need 1024 KB: run ulimit -s 8192", small.stderr)
        for command, code in {"check .": 1, "diff a ../b": 2}.items():
            deleted = subprocess.run(["bash", "-c", f"mkdir gone; cd gone; rmdir ../gone; {sys.executable} {ROOT}/scripts/collektive.py {command}"],
                                     cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(deleted.returncode, code)
            self.assertIn("the current folder was deleted: change to another folder", deleted.stderr)
        closed = subprocess.run(["bash", "-c", f"{COLLEKTIVE} run nowhere.json 2>&-"], capture_output=True, text=True)
        self.assertIn("'nowhere.json' is not a file", closed.stdout)
        closed = subprocess.run(["bash", "-c", f"{COLLEKTIVE} run {self.path('project', 'lamps.json')} --out {self.path('out')} <&- >&- 2>&-"])
        self.assertEqual(closed.returncode, 0)
        self.assertEqual(self.manifest(self.path("out"))["outcome"], "complete")

    @pytest.mark.slow
    def test_a_record_can_be_replayed_with_a_folder_of_kotlin(self) -> None:
        self.change("lamps.json", '"metrics": true', '"record": true')
        self.assertEqual(self.run_it().returncode, 0)
        record, programs, schema = self.path("out", "run.clkrec"), self.path("project", "programs"), self.path("project", "light.fbs")
        self.assertEqual(collektive("replay", record, "--programs", programs, "--schema", schema).returncode, 0)
        self.change("programs/Brightest.kt", "brightest = best", "brightest = best + 1")
        changed = collektive("replay", record, "--programs", programs, "--schema", schema)
        self.assertEqual(changed.returncode, 1)
        self.assertIn("tick 1 is the first difference", changed.stdout)
        for arguments, words in [((), "name its schema"), (("--schema", os.path.join(ROOT, "nowhere.fbs")), "name its schema")]:
            result = collektive("replay", record, "--programs", programs, *arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, last_error(result))
