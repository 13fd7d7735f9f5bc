"""Tests the package, installed in a project."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import installed
import pytest
from command import collektive, jdk, last_error

from build import metas
from build.places import BUILD, ROOT


class InstalledProject:
    """A project in which the package is installed from its tarball, with a player."""

    def __init__(self, archive) -> None:
        self.folder = tempfile.mkdtemp(prefix="collektive-project-")
        self.package = os.path.join(self.folder, "Packages/org.collektive.unity")
        os.makedirs(self.package)
        subprocess.run(["tar", "-xzf", archive, "-C", self.package, "--strip-components=1"], check=True)
        installed.compile_project(Path(self.folder))
        sample = "Packages/org.collektive.unity/unity/Samples~/GradientAscent"
        scenario = {"version": 1, "scene": "CollektiveSamples.GradientAscent.GradientAscentScene", "scripts": sample,
                    "schema": sample + "/gradient_ascent.fbs", "programs": sample + "/gradient_ascent.clkprograms",
                    "program": "gradient-ascent", "fields": {"nodes": 30}, "seconds": 1}
        with open(os.path.join(self.folder, "scenario.json"), "w") as file:
            json.dump(scenario, file)

    def play(self, hidden=(), **environment):
        """Runs the scene with only the given environment variables. The hidden folders appear empty to the process."""
        command = ["mono-sgen", "bin/Collektive.Player.exe", "run", "scenario.json", "--scripts", "bin/GradientAscent.dll",
                   "--jar", "Packages/org.collektive.unity/Samples~/GradientAscent/gradient_ascent.clkprograms", "--out", "out"]
        if hidden:
            hide = 'until [ "$1" = -- ]; do mount -t tmpfs none "$1" || exit 99; shift; done; shift; exec "$@"'
            command = ["unshare", "--mount", "sh", "-c", hide, "sh", *hidden, "--", *command]
        plugins = os.path.join(self.package, "unity/Runtime/Plugins/linux-x64")
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True,
                              env={"PATH": "/usr/bin:/bin", "HOME": self.folder, "LD_LIBRARY_PATH": plugins, **environment})

    def manifest(self):
        with open(os.path.join(self.folder, "out/manifest.json")) as file:
            return json.load(file)

    def remove(self) -> None:
        shutil.rmtree(self.folder)


class Packaged(unittest.TestCase):
    """A test case with a tarball that is built with OPTIONS, and a project in which it is installed."""
    OPTIONS = ()

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.mkdtemp(prefix="collektive-package-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        result = collektive("package", *cls.OPTIONS, "--out", cls.folder)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        cls.archive = result.stdout.strip()
        cls.project = InstalledProject(cls.archive)
        cls.addClassCleanup(cls.project.remove)
        cls.root = cls.project.package


class PackageTest(Packaged):
    def packed(self):
        return {os.path.relpath(os.path.join(where, name), self.root) for where, _, names in os.walk(self.root) for name in names}

    def test_the_package_contains_only_the_files_that_unity_needs(self) -> None:
        # Scenarios are only for runs from the clone, and the manifest in unity/ is only for git URLs.
        excluded = re.compile(r"unity/package\.json|unity/Samples~/[^/]*/scenario\.json")
        expected = {path for path in metas.assets(ROOT) if os.path.isfile(os.path.join(ROOT, path)) and not excluded.fullmatch(path)}
        built = ["Jvm~/collektive-adapter.jar", "Jvm~/collektive-host.jar", "Jvm~/collektive-library.jar",
                 "Runtime/Plugins/Collektive.FlatBuffers.dll",
                 "Runtime/Plugins/linux-x64/libcollektive_shim.so", "Samples~/GradientAscent/Programs/GradientAscent.kt",
                 "Tools~/Links.kt", "Tools~/build.gradle.kts", "Tools~/collektive-compiler-plugin.jar", "Tools~/collektive-generator.jar",
                 "Tools~/collektive-testing.jar", "Tools~/linux-x64/flatc", "Tools~/types.fbs"]
        expected |= {"unity/" + path for path in built}
        expected |= {str(path.relative_to(ROOT).with_suffix(".clkprograms")) for path in (ROOT / "unity/Samples~").glob("*/*.fbs")}
        for code in (BUILD / "generated/bridge").rglob("*.cs"):
            expected.add(f"unity/Runtime/Bridge/Generated/{code.relative_to(BUILD / 'generated/bridge')}")
        for code in (BUILD / "generated/samples").rglob("*.cs"):
            sample, *parts = code.relative_to(BUILD / "generated/samples").parts
            expected.add("/".join(["unity/Samples~", sample, "Generated", *parts]))
        expected |= {path + ".meta" for path in metas.assets(self.root)}
        extra = [path for path in self.packed() - expected if not re.match(r"Documentation~/|unity/Samples~/[^/]*/Programs/", path)]
        self.assertEqual(extra, [])
        self.assertEqual(sorted(expected - self.packed()), [])

    def test_every_asset_has_its_meta(self) -> None:
        self.assertEqual(list(metas.problems(self.root)), [])

    def test_the_package_contains_all_links_and_pictures_of_its_pages(self) -> None:
        pages = sorted(path for path in self.packed() if re.fullmatch(r"[^/]*\.md|Documentation~/.*\.md", path))
        self.assertIn("README.md", pages)
        self.assertIn("Documentation~/index.md", pages)
        lost = []
        for page in pages:
            with open(os.path.join(self.root, page)) as file:
                text = file.read()
            links = [os.path.join(os.path.dirname(page), link) for link in re.findall(r"\]\((?!https:)([^)#]+)[^)]*\)", text)]
            # Text may also name a page by its path from the root of the package.
            links += re.findall(r"`((?:Documentation~|docs)/[^`:]+)`(?!\s+(?:in|of)\s+the\s+repository)", text)
            lost += [f"{page}: {link}" for link in links if os.path.normpath(link) not in self.packed()]
        self.assertEqual(lost, [])

    def test_plugins_are_enabled_only_on_their_platforms(self) -> None:
        with open(os.path.join(self.root, "unity/Runtime/Plugins/linux-x64/libcollektive_shim.so.meta")) as file:
            native = file.read()
        self.assertRegex(native, r"Any: \n    second:\n      enabled: 0")
        self.assertRegex(native, r"Editor: Editor\n    second:\n      enabled: 1\n      settings:\n        CPU: x86_64\n .*\n        OS: Linux")
        self.assertRegex(native, r"Standalone: Linux64\n    second:\n      enabled: 1")

    def test_the_same_sources_give_the_same_bytes(self) -> None:
        first = digest(self.archive)
        again = os.path.join(self.folder, "again")
        self.assertEqual(collektive("package", "--out", again).returncode, 0)
        self.assertEqual(digest(os.path.join(again, os.path.basename(self.archive))), first)

    def test_the_assembly_contains_no_build_paths(self) -> None:
        # The assembly must have no symbols. Symbols contain the paths of the sources, and the assembly would contain the id of its symbols.
        with open(os.path.join(self.root, "unity/Runtime/Plugins/Collektive.FlatBuffers.dll"), "rb") as file:
            self.assertNotIn(b".pdb", file.read())

    def test_a_scene_runs_from_the_package_without_the_clone(self) -> None:
        # Neither the project nor the environment refers to the clone.
        self.assertEqual(subprocess.run(["grep", "-rlF", ROOT, self.project.folder], capture_output=True, text=True).stdout, "")
        result = self.project.play(JAVA_HOME=jdk())
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        ran = self.project.manifest()
        self.assertEqual((ran["nodes"], ran["ticks"], ran["errors"]), (30, 20, 0))

    @pytest.mark.slow
    def test_a_missing_jvm_is_reported_with_the_solutions(self) -> None:
        result = self.project.play()
        self.assertEqual(result.returncode, 1)
        self.assertIn("install org.collektive.unity.jvm.linux-x64, set JAVA_HOME, or select a folder", last_error(result))

    def test_unknown_arguments_are_reported(self) -> None:
        result = collektive("package", "--nonesuch")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--nonesuch", last_error(result))


@pytest.mark.slow
class JvmPackageTest(Packaged):
    OPTIONS = ("--jre",)

    @property
    def home(self):
        return os.path.join(self.root, "unity/Jvm~/linux-x64")

    def test_the_package_with_a_jvm_has_another_file_name(self) -> None:
        self.assertRegex(os.path.basename(self.archive), r"^org\.collektive\.unity-[0-9.]+-jre\.tgz$")

    def test_the_jvm_includes_archive_licences_debugger_and_recorder(self) -> None:
        for path in ["lib/server/classes.jsa", "lib/libjdwp.so", "lib/jfr/default.jfc", "lib/jfr/profile.jfc", "bin/java", "bin/jfr", "bin/jcmd"]:
            self.assertTrue(os.path.isfile(os.path.join(self.home, path)), path)
        for module in ["java.base", "jdk.jfr", "jdk.jdwp.agent"]:
            self.assertGreater(os.path.getsize(os.path.join(self.home, "legal", module, "LICENSE")), 1000, module)
        self.assertTrue(os.access(os.path.join(self.home, "bin/java"), os.X_OK))

    def test_a_scene_runs_without_java_variables_and_clone(self) -> None:
        if os.geteuid() != 0:
            self.skipTest("only root can hide the clone and the machine's JDKs from a process")
        jdks = {"/usr/lib/jvm", jdk()}
        hidden = [ROOT, *sorted((path for path in jdks if os.path.isdir(path)), reverse=True)]  # nested folders first
        result = self.project.play(hidden)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        ran = self.project.manifest()
        self.assertEqual((ran["nodes"], ran["ticks"], ran["errors"]), (30, 20, 0))

    def test_the_bundled_jvm_takes_precedence_over_java_home(self) -> None:
        result = self.project.play(JAVA_HOME="/nowhere/jdk")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()
