"""Tests a project that ./collektive new creates."""
import os
import re
import subprocess

import pytest
from command import ROOT, Folder, collektive, last_error

from build import fetch
from build.jdk import find_jdk
from build.places import BUILD
from commands.new import RESERVED


class NewTest(Folder):
    def test_a_new_project_passes_its_tests_and_its_scenario_and_experiment_run(self) -> None:
        created = collektive("new", "herd", cwd=self.folder)
        self.assertEqual(created.returncode, 0, created.stderr)
        self.assertEqual(os.listdir(self.folder), ["herd"])
        self.assertEqual(sorted(os.listdir(self.path("herd"))), ["build.gradle.kts", "experiment.json", "herd.fbs", "programs",
                                                                        "scenario.json", "scene", "settings.gradle.kts", "tests"])
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

    def test_the_other_nodes_of_a_new_project_continue_after_one_was_destroyed(self) -> None:
        self.assertEqual(collektive("new", "herd", cwd=self.folder).returncode, 0)
        with open(self.path("herd", "scene", "Remove.cs"), "w") as file:
            file.write("public static class Remove { [UnityEngine.RuntimeInitializeOnLoadMethod] private static void Run() =>"
                       " UnityEngine.Object.Destroy(Collektive.Unity.SimulationManager.Current.Nodes[0].gameObject); }")
        ran = collektive("run", "herd/scenario.json", "--out", "out", "--set", "seconds=1", "--set", "outputs.replay=false", cwd=self.folder)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual(self.manifest(self.path("out"))["nodes"], 99)

    @pytest.mark.slow
    def test_the_kotlin_compiles_with_the_files_that_the_gradle_build_names(self) -> None:
        created = collektive("new", "herd", cwd=self.folder)
        self.assertEqual(created.returncode, 0, created.stderr)
        with open(self.path("herd", "settings.gradle.kts")) as file:
            self.assertEqual(file.read(), 'rootProject.name = "herd"\n')
        with open(self.path("herd", "build.gradle.kts")) as file:
            text = file.read()
        self.assertNotRegex(text, "@[A-Z]+@")
        names = dict(re.findall(r'^val (\w+) = (?:files\()?(".*")\)?$', text, re.M))
        self.assertEqual(set(names), {"library", "testing", "plugin", "generator", "flatc", "types", "schemas", "programs"})
        paths = {name: [os.path.join(self.path("herd"), path) for path in re.findall(r'"([^"]+)"', value)] for name, value in names.items()}
        self.assertEqual([path for values in paths.values() for path in values if not os.path.exists(path)], [])
        self.assertIn(f'kotlin("jvm") version "{fetch.pom_value("kotlin.version")}"', text)
        generated = self.path("generated")
        java = find_jdk() / "bin/java"
        subprocess.run([java, "-jar", *paths["generator"], "--flatc", *paths["flatc"], "--include", *paths["types"], "--jvm", generated,
                        "--schema", *paths["schemas"]], check=True)
        junit = sorted((BUILD / "junit").glob("*.jar"))
        result = subprocess.run(
            [java, "-cp", f"{BUILD}/kotlinc/*", "org.jetbrains.kotlin.cli.jvm.K2JVMCompiler", "-no-stdlib", "-no-reflect", "-jvm-target", "17",
             "-d", self.path("classes"),
             "-cp", ":".join(map(str, [*paths["library"], *paths["testing"], *junit])), f"-Xplugin={paths['plugin'][0]}",
             *paths["programs"], self.path("herd", "tests"), generated],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertTrue(os.path.exists(self.path("classes", "herd", "HerdKt.class")))

    def test_namespaces_that_the_generator_refuses_are_reserved(self) -> None:
        with open(os.path.join(ROOT, "jvm-host/generator/src/main/kotlin/org/collektive/generator/ReservedNames.kt")) as file:
            lists = re.findall(r'val (?:kotlin|reserved|roots|packages)\b[^=]*=[^"]*"""([^"]*)"""', file.read())
        self.assertEqual(len(lists), 4)
        self.assertEqual({word for words in lists for word in words.split() if re.fullmatch("[a-z][a-z0-9]*", word)} - RESERVED, set())

    def test_an_existing_folder_is_kept_and_invalid_names_are_refused(self) -> None:
        os.mkdir(self.path("herd"))
        os.symlink("nowhere", self.path("link"))
        for name, message in (("herd", "'herd' already exists"), ("link", "'link' already exists"),
                              ("Herd", "must consist of lower-case letters"), ("../up", "must consist of"), ("class", "'class' is a reserved word")):
            result = collektive("new", name, cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(message, last_error(result))
        self.assertEqual(os.listdir(self.path("herd")), [])
