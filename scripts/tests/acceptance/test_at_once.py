"""Tests that simultaneous runs of one project safely share compiled code and the JVM's class archive."""
import json
import os
import subprocess

import pytest
from command import Project, jdk

from build.places import COLLEKTIVE, ROOT

RUNS = 3
HOST_JAR = os.path.join(ROOT, "jvm-host/host/target/collektive-host.jar")


class SimultaneousCommandsTest(Project):
    @pytest.mark.slow
    def test_simultaneous_first_runs_share_compiled_code_and_one_class_archive(self) -> None:
        with open(self.path("project", "scene", "Lamps.cs"), "a") as file:
            file.write(f"// {self.folder} {os.getpid()}: nothing of it is compiled yet\n")
        home = self.path("home")
        os.mkdir(home)
        environment = {**os.environ, "HOME": home}
        environment.pop("XDG_DATA_HOME", None)
        for turn in ("first", "second"):
            runs = [subprocess.Popen([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path(f"{turn}-{i}")], env=environment,
                                     stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for i in range(RUNS)]
            for run in runs:
                errors = run.communicate(timeout=300)[1]
                self.assertEqual(run.returncode, 0, errors)
                self.assertNotIn("warning", errors.lower())
        manifests = [self.manifest(self.path(f"{turn}-{i}")) for turn in ("first", "second") for i in range(RUNS)]
        self.assertEqual({manifest["outcome"] for manifest in manifests}, {"complete"})
        self.assertEqual(len({json.dumps(manifest["digest"]) for manifest in manifests}), 1)
        files = [os.path.join(place, name) for place, _, names in os.walk(home) for name in names]
        archives = [file for file in files if file.endswith(".jsa")]
        self.assertEqual(len(archives), 1, files)
        # With these options, the JVM verifies the checksum of the archive.
        java = [os.path.join(jdk(), "bin/java"), "-Xshare:on", "-XX:+VerifySharedSpaces", f"-XX:SharedArchiveFile={archives[0]}", "-XX:+UseSerialGC"]
        checked = subprocess.run([*java, "-cp", HOST_JAR, "-version"], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr + checked.stdout)

    def test_a_scenario_that_changes_during_compilation_is_not_run(self) -> None:
        self.change("programs/Brightest.kt", "val mine", f"/* {self.folder} {os.getpid()}: not compiled yet */ val mine")
        run = subprocess.Popen([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out")], stderr=subprocess.PIPE, text=True)
        assert run.stderr is not None
        for line in run.stderr:
            if "compile-programs" in line:
                self.change("lamps.json", '"seconds": 1', '"seconds": 2')
        self.assertEqual(run.wait(), 1)
        self.assertIn("lamps.json' changed during compilation: run the command again", line)
        self.assertFalse(os.path.exists(self.path("out")))
