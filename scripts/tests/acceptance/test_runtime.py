"""Tests programs on Collektive's own runtime, with jars and a compiler plugin that the user provides.

Collektive's jars are not available to the tests. Two jars with the DSL and the standard library of the package stand in for them, and the package's
compiler plugin stands in for Collektive's plugin.
"""
import csv
import glob
import json
import os
import re
import zipfile
from pathlib import Path

import pytest
from command import Project, collektive, compiled

from build import inputs, projects
from build.places import ROOT

LIBRARY = os.path.join(ROOT, "jvm-host/host/target/collektive-library.jar")
PLUGIN = glob.glob(os.path.join(ROOT, "jvm-host/compiler-plugin/target/compiler-plugin-*[0-9].jar"))
STDLIB = "it/unibo/collektive/stdlib/"
SETTINGS = '"runtime": "collektive", "runtimeJars": "collektive", "runtimePlugin": "plugin.jar"'


def repack(source, target, keeps=lambda name: True, change=lambda name, data: data) -> None:
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            if keeps(name) and not name.endswith("/"):
                new.writestr(name, change(name, old.read(name)))


class Runtimes(Project):
    def setUp(self) -> None:
        super().setUp()
        os.mkdir(self.path("project", "collektive"))
        repack(LIBRARY, self.jar("dsl"), lambda name: not name.startswith(STDLIB))
        repack(LIBRARY, self.jar("stdlib"), lambda name: name.startswith(STDLIB) or "stdlib" in name)
        repack(PLUGIN[0], self.path("project", "plugin.jar"))
        # The changed program uses the standard library and the lengths of links.
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()",
                    "val mine = sensors.brightness() + 0f * (hopDistanceTo(localId == 0) + with(device) { distances() }.local.value.toInt())")
        self.change("programs/Brightest.kt", "(sensors: SensorData)", "(sensors: SensorData, device: Device)")
        self.change("programs/Brightest.kt", "import org.collektive.api.Program", "\n".join([
            "import it.unibo.collektive.stdlib.spreading.hopDistanceTo", "import org.collektive.api.Device", "import org.collektive.api.Program",
            "import org.collektive.links.distances"]))
        self.change("lamps.json", '"metrics": true', '"metrics": true, "record": true')

    def jar(self, name):
        return self.path("project", "collektive", name + ".jar")

    def switch(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, ' + SETTINGS)

    def run_it(self, out="out"):
        return collektive("run", self.path("project", "lamps.json"), "--out", self.path(out), "--overwrite")

    def completed(self, out="out"):
        result = self.run_it(out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, *words) -> None:
        result = self.run_it()
        self.assertNotEqual(result.returncode, 0)
        for word in words:
            self.assertIn(word, result.stderr)

    def collektive_jar(self):
        """Returns the jar that a run on Collektive has compiled from the current programs."""
        project = Path(self.path("project"))
        return compiled(projects.programs_jar, inputs.schema(project / "light.fbs"), inputs.programs(project / "programs"), inputs.jars(project / "collektive"),
                        inputs.jar(project / "plugin.jar"))

    def use_jar(self, jar, change=lambda name, data: data) -> None:
        repack(jar, self.path("project", "programs.jar"), change=change)
        self.change("lamps.json", '"programs": "programs"', '"programs": "programs.jar"')

    def test_both_runtimes_give_the_same_run_and_their_records_are_compared(self) -> None:
        first = self.completed("a")
        self.switch()
        second = self.completed("b")
        a, b = self.manifest(self.path("a")), self.manifest(self.path("b"))
        self.assertEqual(a["digest"], b["digest"])
        self.assertEqual([a["scenario"]["runtime"], b["scenario"]["runtime"]], ["BuiltIn", "Collektive"])
        self.assertIn("runtimeJars", b["inputs"])
        self.assertIn(f"digest {a['digest']}\n", first.stdout)
        self.assertIn(f"digest {b['digest']} (runtime Collektive)\n", second.stdout)
        compared = collektive("diff", self.path("a", "run.clkrec"), self.path("b", "run.clkrec"))
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)
        self.assertIn("different runtimes: the built-in runtime in A, the Collektive runtime in B", compared.stdout)
        self.assertIn("10 ticks without a difference", compared.stdout)
        repeated = collektive("repeat", self.path("b", "manifest.json"))
        self.assertEqual(repeated.returncode, 0, repeated.stderr)

    @pytest.mark.slow
    def test_a_sweep_runs_both_runtimes_with_equal_digests(self) -> None:
        self.switch()
        self.change("lamps.json", '"runtime": "collektive", ', "")
        experiment = Path(self.path("project", "both.json"))
        experiment.write_text(json.dumps({"version": 1, "scenario": "lamps.json", "vary": {"runtime": ["BuiltIn", "Collektive"], "seed": "1-2"}}))
        result = collektive("sweep", experiment, "--out", self.path("sweep"), "--csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("sweep", "runs.csv")) as file:
            rows = {(row["runtime"], row["seed"]): row for row in csv.DictReader(file)}
        self.assertEqual(len(rows), 4)
        for seed in "1", "2":
            self.assertEqual(rows["BuiltIn", seed]["digest"], rows["Collektive", seed]["digest"])
        for run, has_jars in (("BuiltIn", False), ("Collektive", True)):
            manifest = self.manifest(glob.glob(self.path("sweep", "runs", f"runtime={run},seed=1-*"))[0])
            self.assertEqual((manifest["scenario"]["runtime"], "runtimeJars" in manifest["inputs"]), (run, has_jars))
        marks = {zipfile.ZipFile(jar).read("META-INF/MANIFEST.MF") for jar in glob.glob(self.path("sweep", "bundle", "programs*.jar"))}
        self.assertEqual(len(marks), 2)

    def test_a_sweep_of_an_unknown_runtime_is_refused_with_its_line(self) -> None:
        experiment = Path(self.path("project", "both.json"))
        experiment.write_text('{"version": 1, "scenario": "lamps.json",\n"vary": {"runtime": ["BuiltIn", "ScaFi"]}}')
        result = collektive("sweep", experiment, "--out", self.path("sweep"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("both.json:2: 'vary.runtime' is \"ScaFi\"; it must be BuiltIn or Collektive", result.stderr)

    @pytest.mark.slow
    def test_a_record_is_replayed_on_the_other_runtime(self) -> None:
        self.completed("a")
        record = self.path("a", "run.clkrec")
        other = ["--runtime", "collektive", "--runtime-jars", self.path("project", "collektive")]
        refused = collektive("replay", record, *other)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("was compiled for the built-in runtime, and this session runs on the Collektive runtime", refused.stderr)
        programs = ["--programs", self.path("project", "programs"), "--schema", self.path("project", "light.fbs"),
                    "--runtime-plugin", self.path("project", "plugin.jar"), "--out", self.path("b.clkrec")]
        replayed = collektive("replay", record, *other, *programs)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        self.assertIn("10 ticks replayed, all digests equal the record", replayed.stdout)
        self.assertIn("(Collektive runtime)", replayed.stdout)
        compared = collektive("diff", record, self.path("b.clkrec"))
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)
        # The record of the replay names the runtime and its jars, and contains the programs, so it can be replayed without further options.
        again = collektive("replay", self.path("b.clkrec"), "--trust")
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        stranger = collektive("replay", self.path("b.clkrec"), "--programs", self.collektive_jar())
        self.assertEqual(stranger.returncode, 2, stranger.stdout)
        self.assertIn("uses the runtime jars in", stranger.stderr)
        os.mkfifo(self.path("project", "collektive", "pipe.jar"))
        refused = collektive("replay", record, *other)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("pipe.jar cannot be read: java.io.IOException: it is not a file", refused.stderr)

    def test_an_error_in_a_round_names_node_and_position(self) -> None:
        self.change("programs/Brightest.kt", "val heard", 'check(localId != 3) { "three is too dark" }\n    val heard')
        self.switch()
        self.refused("three is too dark [node 3 at ", "Brightest.kt:")

    @pytest.mark.slow
    def test_programs_for_the_other_runtime_are_rejected(self) -> None:
        self.use_jar(self.programs_jar())
        self.switch()
        self.refused("programs.jar was compiled for the built-in runtime, and this session runs on the Collektive runtime",
                     "Rebuild the programs")

    @pytest.mark.slow
    def test_programs_for_collektive_are_rejected_by_the_built_in_runtime(self) -> None:
        self.switch()
        self.completed()
        self.use_jar(self.collektive_jar())
        self.change("lamps.json", ", " + SETTINGS, "")
        self.refused("programs.jar was compiled for the Collektive runtime, and this session runs on the built-in runtime")

    @pytest.mark.slow
    def test_missing_or_incompatible_jars_are_reported(self) -> None:
        self.switch()
        self.completed()
        marked = self.collektive_jar()
        os.remove(self.jar("stdlib"))
        self.use_jar(marked)
        self.refused("programs.jar was compiled with different jars than those of the Collektive runtime of " + self.path("project", "collektive"))

        # A jar that another tool has compiled does not name its runtime.
        repack(marked, self.path("project", "programs.jar"), lambda name: name != "META-INF/MANIFEST.MF")
        self.refused("references it.unibo.collektive.stdlib.", "which is missing in the Collektive runtime", "its jars is missing or has the wrong version")

        repack(LIBRARY, self.jar("stdlib"), lambda name: name.startswith(STDLIB))
        repack(LIBRARY, self.jar("dsl"), lambda name: not name.startswith(STDLIB), lambda name, data: data.replace(b"getNewState", b"getNewStage"))
        self.refused("does not work: java.lang.NoSuchMethodError", "of another version than 28.3")

        with open(self.jar("dsl"), "wb") as file:
            file.write(b"no jar")
        self.refused("dsl.jar cannot be read", "replace it with a valid copy")

        os.remove(self.jar("dsl"))
        os.remove(self.jar("stdlib"))
        self.refused("folder " + self.path("project", "collektive") + " contains no jar", "dsl and stdlib")

    @pytest.mark.slow
    def test_an_invalid_or_incompatible_plugin_is_reported(self) -> None:
        self.switch()
        plugin = self.path("project", "plugin.jar")
        repack(LIBRARY, plugin)
        self.refused(f"{plugin} is not a plugin of the Kotlin compiler")
        with open(plugin, "w", encoding="utf-8") as file:
            file.write("not a jar")
        self.refused(f"{plugin} is not a plugin of the Kotlin compiler")
        # The changed plugin lacks a method, as a plugin for another version of the compiler does.
        repack(PLUGIN[0], plugin, change=lambda name, data: data.replace(b"registerExtensions", b"registerExtensionz"))
        self.refused("the compiler plugin may be built for another version")

    def test_settings_without_jars_or_plugin_are_rejected_with_their_line(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, "runtime": "collektive"')
        self.refused("the key 'runtimeJars' is missing")
        self.change("lamps.json", '"runtime": "collektive"', '"runtime": "collektive", "runtimeJars": "nowhere"')
        self.refused("'runtimeJars' does not name a folder: " + self.path("project", "nowhere"))
        self.change("lamps.json", "nowhere", "collektive")
        self.refused("the key 'runtimePlugin' is missing")
        self.change("lamps.json", '"runtime": "collektive"', '"runtime": "alchemist"')
        self.assertTrue(re.search(r"lamps\.json:\d+: 'runtime' is \"alchemist\".*one of BuiltIn, Collektive", self.run_it().stderr))
