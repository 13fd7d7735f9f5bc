"""Tests that an output folder belongs to one run, and that its manifest contains the outcome of the run."""
import json
import os
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import pytest
import replay
from command import Project, collektive, last_error, processes

from build.places import BUILD, COLLEKTIVE


class Outputs(Project):
    def run_it(self, *arguments, out="out"):
        return collektive("run", self.path("project", "lamps.json"), "--out", self.path(out), *arguments)

    def contents(self, out="out"):
        found = {}
        for name in sorted(os.listdir(self.path(out))):
            with open(self.path(out, name), "rb") as file:
                found[name] = file.read()
        return found

    def outcome(self):
        return self.manifest(self.path("out"))["outcome"]

    def test_a_replay_without_colourings_shows_answers_of_nodes(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        self.assertEqual(self.run_it().returncode, 0)
        _, frames, _ = replay.read(self.path("out", "replay.html"))
        _, nodes = frames[-1]
        brightest = {round(value, 3) for *_, value in nodes.values()}
        self.assertEqual(len(brightest), 1, "in the end, all lamps must have the same answer")

    @pytest.mark.slow
    def test_capsules_and_directions_of_links_are_in_the_replay(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        self.change("scene/Lamps.cs", "lamp.AddComponent<LampActuator>();", """lamp.AddComponent<LampActuator>();
                lamp.AddComponent<CapsuleCollider>().height = 3;
                var reach = lamp.AddComponent<SphereCollider>();
                reach.isTrigger = true;
                reach.radius = 9;""")
        self.change("scene/Lamps.cs", "if (loop)", """var post = new GameObject("Post").AddComponent<CapsuleCollider>();
            post.transform.position = new Vector3(4, 1, 5);
            post.direction = 2;
            post.height = 6;
            manager.AddLink(nodes[0].Id, nodes[2].Id, true);
            if (loop)""")
        result = self.run_it()
        self.assertEqual(result.returncode, 0, result.stderr)
        metadata, frames, links = replay.read(self.path("out", "replay.html"))
        self.assertEqual((metadata["nodeRadius"], metadata["nodeHeight"]), (0.5, 3))
        shape = {"kind": "capsule", "radius": 0.5, "height": 6, "axis": 2, "centre": [4, 1, 5], "rotation": [0, 0, 0, 1]}
        self.assertEqual(metadata["shapes"], [shape])
        _, nodes = frames[-1]
        first, second, third = sorted(nodes)[:3]
        self.assertEqual({link for link in links if first in link}, {(first, second), (second, first), (first, third)})

    def test_results_are_kept_without_overwrite(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true, "record": true')
        self.assertEqual(self.run_it().returncode, 0)
        before = self.contents()
        self.assertEqual(list(before), ["manifest.json", "metrics.csv", "replay.html", "run.clkrec"])
        self.assertEqual(self.outcome(), "complete")
        refused = self.run_it("--seed", "2")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("has results of a run: manifest.json, metrics.csv, replay.html, run.clkrec; name another folder", last_error(refused))
        self.assertEqual(self.contents(), before)
        # The run must remove earlier outputs, even if it does not write them itself.
        self.change("lamps.json", '"replay": true, "record": true', '"replay": false')
        self.assertEqual(self.run_it("--overwrite").returncode, 0)
        self.assertEqual(list(self.contents()), ["manifest.json", "metrics.csv"])

    def test_results_are_on_the_disk_before_the_manifest_that_calls_them_complete(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "nodes": { "fields": ["brightest"] }, "replay": true, "pictures": true, "record": true')
        syncs, out = Path(self.path("syncs")), Path(os.path.realpath(self.path("out")))
        syncs.touch()
        result = subprocess.run([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", str(out)], capture_output=True, text=True,
                                env={**os.environ, "LD_PRELOAD": str(BUILD / "failing.so"), "FAILING_SYNCS": str(syncs)})
        self.assertEqual(result.returncode, 0, result.stderr)
        synced = [path for path in map(Path, syncs.read_text().splitlines()) if path == out or path.parent == out]
        self.assertEqual(synced[-2:], [out / "manifest.json.part", out])
        results = {path.name for path in out.iterdir()} - {"manifest.json"}
        self.assertEqual(len(results), 7)
        self.assertLessEqual(results, {path.name for path in synced[:-2]})

    def test_a_run_that_cannot_start_keeps_earlier_results(self) -> None:
        self.assertEqual(self.run_it().returncode, 0)
        before = self.contents()
        for arguments in [("--seed", "1.5"), ("--seconds", "-1"), ("--set", "lamps=many"), ("--set", "candles=3"), ("--set", "scene=Lamps.Nonesuch"),
                          ("--set", "outputs.nodes.fields=[\"nonesuch\"]"), ("--set", "jvm.flags=[\"-Xss1k\"]")]:
            self.assertEqual(self.run_it("--overwrite", *arguments).returncode, 1, arguments)
            self.assertEqual(self.contents(), before, arguments)
        self.change("scene/Lamps.cs", "if (loop) ", "Application.Quit(3); if (loop) ")
        self.assertEqual(self.run_it("--overwrite").returncode, 3)
        self.assertEqual(self.contents(), before)

    def test_an_answer_named_like_the_position_of_nodes_is_rejected_as_a_column(self) -> None:
        self.change("light.fbs", "seen: [int];", "seen: [int]; position: float;")
        result = self.run_it("--set", 'outputs.nodes.fields=["position"]')
        self.assertEqual(result.returncode, 1)
        self.assertIn("'position' is both the node's position and a field of the answers", last_error(result))

    @pytest.mark.slow
    def test_a_run_that_crashes_in_its_first_tick_keeps_earlier_results(self) -> None:
        self.assertEqual(self.run_it().returncode, 0)
        before = self.contents()
        self.change("scene/Lamps.cs", "data.Brightness = Brightness;", "System.Diagnostics.Process.GetCurrentProcess().Kill();")
        self.assertEqual(self.run_it("--overwrite").returncode, 137)
        self.assertEqual(self.contents(), before)

    def test_a_run_leaves_no_socket_of_the_jvm(self) -> None:
        self.change("scene/Lamps.cs", "data.Brightness = Brightness;", "data.Brightness = Brightness;\n            "
                    f'System.IO.File.WriteAllText("{self.path("pid")}", System.Diagnostics.Process.GetCurrentProcess().Id.ToString());')
        self.assertEqual(self.run_it().returncode, 0)
        with open(self.path("pid")) as file:
            self.assertFalse(os.path.lexists(f"/tmp/.java_pid{file.read()}"))

    def test_a_killed_run_leaves_its_rows_and_an_incomplete_manifest(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        self.assertEqual(self.run_it().returncode, 0)
        process = subprocess.Popen([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out"), "--overwrite",
                                    "--seconds", "1000000"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.wait_until(lambda: os.path.exists(self.path("out", "metrics.csv")) and len(self.rows()) >= 20)
        for pid in processes("Collektive.Player.exe", self.path("out")):
            os.kill(pid, signal.SIGKILL)
        messages = process.communicate()[1]
        self.assertEqual(process.returncode, 137)
        self.assertIn("the player was killed during the run", messages.splitlines()[-1])
        self.assertEqual(self.outcome(), "running")
        self.assertNotIn("replay.html", self.contents())
        repeated = collektive("repeat", self.path("out", "manifest.json"), "--out", self.path("again"))
        self.assertEqual(repeated.returncode, 1)
        self.assertIn("the run was not completed", last_error(repeated))

    def test_symbolic_links_in_the_output_folder_are_replaced_and_not_followed(self) -> None:
        names = ["manifest.json", "metrics.csv", "metrics.csv.part", "replay.html", "replay.tmp"]
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        # The scene creates the symbolic links while it is built, so they appear after the command has prepared the folder.
        links = " ".join(f'System.Diagnostics.Process.Start("ln", "-sf {self.path("outside")} {self.path("out", name)}").WaitForExit();' for name in names)
        self.change("scene/Lamps.cs", "Build(SimulationManager manager)\n        {", f"Build(SimulationManager manager)\n        {{\n            {links}")
        with open(self.path("outside"), "w") as file:
            file.write("mine")
        result = self.run_it()
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("outside")) as file:
            self.assertEqual(file.read(), "mine")
        self.assertEqual([name for name in os.listdir(self.path("out")) if os.path.islink(self.path("out", name))], ["metrics.csv.part"])

    @pytest.mark.slow
    def test_outputs_do_not_depend_on_scripts_that_change_the_current_folder(self) -> None:
        os.mkdir(self.path("elsewhere"))
        self.change("scene/Lamps.cs", "Build(SimulationManager manager)\n        {", "Build(SimulationManager manager)\n        {\n"
                    f'            System.IO.Directory.SetCurrentDirectory("{self.path("elsewhere")}");')
        result = collektive("run", "project/lamps.json", "--out", "out", "--recording", "run.jfr", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(list(self.contents()), ["manifest.json", "metrics.csv"])
        self.assertTrue(os.path.exists(self.path("run.jfr")))
        self.assertEqual(os.listdir(self.path("elsewhere")), [])

    def test_the_output_folder_can_be_a_symbolic_link(self) -> None:
        os.mkdir(self.path("out"))
        os.symlink("out", self.path("link"))
        result = self.run_it(out="link")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.outcome(), "complete")

    def test_parent_folders_of_symbolic_links_are_those_of_their_targets(self) -> None:
        os.makedirs(self.path("elsewhere", "deep"))
        os.symlink("elsewhere/deep", self.path("link"))
        shutil.copytree(self.path("project"), self.path("elsewhere", "project"))
        self.change("lamps.json", '"version": 1', '"version": 1, "seed": 7')
        for command, out in [("run", "--out=link/../out"), ("profile", "--out=link/../profiled")]:
            result = collektive(command, "link/../project/lamps.json", out, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["elsewhere", "link", "project"])
        manifest = self.manifest(self.path("elsewhere", "out"))
        self.assertEqual((manifest["folder"], manifest["scenario"]["seed"]), (os.path.realpath(self.path("elsewhere", "project")), 1))
        self.assertTrue(os.path.exists(self.path("elsewhere", "profiled", "profile.jfr")))

    @pytest.mark.alone
    def test_a_player_killed_by_a_shell_limit_is_reported_in_one_line(self) -> None:
        # Compiles the project, which the limit would prevent.
        self.assertEqual(collektive("check", self.path("project", "lamps.json")).returncode, 0)
        command = ["bash", "-c", 'ulimit -f 1; exec "$@"', "bash", COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out")]
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 128 + signal.SIGXFSZ, result.stderr)
        self.assertIn("the player was ended by SIGXFSZ", last_error(result))

    def test_a_run_whose_pictures_fail_is_incomplete(self) -> None:
        self.change("lamps.json", '"metrics": true', '"replay": true, "pictures": true')
        os.mkdir(self.path("bin"))
        with open(os.open(self.path("bin", "node"), os.O_WRONLY | os.O_CREAT, 0o755), "w") as file:
            file.write(f'#!/bin/sh\ncase "$1" in *pictures*) exit 1;; *) exec {shutil.which("node")} "$@";; esac\n')
        result = subprocess.run([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out")], capture_output=True, text=True,
                                env={**os.environ, "PATH": f"{self.path('bin')}:{os.environ['PATH']}"})
        self.assertEqual(result.returncode, 1)
        self.assertIn("pictures failed", last_error(result))
        self.assertEqual(self.outcome(), "the pictures are missing")

    def rows(self):
        with open(self.path("out", "metrics.csv")) as file:
            return file.readlines()

    def test_the_manifest_of_a_failed_run_contains_the_reason(self) -> None:
        self.change("scene/Lamps.cs", "data.Brightness = Brightness;", "data.Brightness = SimulationManager.Current.Tick < 4 ? Brightness : float.NaN;")
        result = self.run_it()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(self.outcome(), "^failed: stopped at tick 5: (?!tick).*not finite")

    def test_a_second_run_into_the_same_folder_is_rejected(self) -> None:
        command = [COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out"), "--seconds", "1000000"]
        first = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_until(lambda: os.path.exists(self.path("out", "manifest.json")))
        second = self.run_it("--overwrite")
        self.assertEqual(second.returncode, 1)
        self.assertIn("another run writes to", last_error(second))
        first.send_signal(signal.SIGTERM)
        first.wait()
        self.assertEqual(self.outcome(), "interrupted")

    def test_unwritable_folders_are_reported_in_one_line(self) -> None:
        with open(self.path("file"), "w"):
            pass
        os.symlink(self.path("nowhere", "deep"), self.path("dangling"))
        for out in ["file", "file/below", "x" * 300, "dangling"]:
            result = self.run_it(out=out)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(last_error(result), "cannot create the output folder .*; name another folder with --out", out)
        read_only = collektive("run", self.path("project", "lamps.json"), "--out", "/proc/results")
        self.assertEqual(read_only.returncode, 1)
        self.assertRegex(last_error(read_only), "^collektive: cannot create the output folder ")

    def test_the_default_folder_is_named_after_the_used_seed(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, "seed": 77')
        for arguments, name in [((), "lamps-seed77"), (("--seed", "5"), "lamps-seed5")]:
            result = collektive("run", self.path("project", "lamps.json"), *arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertTrue(os.path.isfile(self.path("out", name, "manifest.json")))


@unittest.skipUnless(os.geteuid() == 0, "only root can mount a small file system")
class FullDisks(Project):
    def test_a_full_home_disk_disables_the_class_archive(self) -> None:
        os.makedirs(self.path("home"))
        script = 'mount -t tmpfs -o size=1m none "$HOME" && "$@"'
        result = subprocess.run(["unshare", "--mount", "sh", "-c", script, "sh", COLLEKTIVE, "run", self.path("project", "lamps.json"),
                                 "--out", self.path("out")], capture_output=True, text=True, env={**os.environ, "HOME": self.path("home")})
        if "mount:" in result.stderr or "unshare:" in result.stderr:
            self.skipTest("mounting is not permitted")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no class archive is written", result.stdout + result.stderr)

    @pytest.mark.slow
    def test_a_full_disk_is_reported_in_one_line_and_no_output_looks_complete(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        self.change("lamps.json", '"seconds": 1', '"seconds": 20')
        reached = set()
        for kilobytes in [4, 8, 64, 700, 1000]:
            script = 'mount -t tmpfs -o size=$1k none "$2" && { shift 2; "$@"; }; code=$?; cp -r "$OUT" "$KEEP"; exit $code'
            os.makedirs(self.path("disk"), exist_ok=True)
            with tempfile.TemporaryDirectory() as keep:
                result = subprocess.run(["unshare", "--mount", "sh", "-c", script, "sh", str(kilobytes), self.path("disk"), COLLEKTIVE, "run",
                                         self.path("project", "lamps.json"), "--out", self.path("disk", "out")], capture_output=True, text=True,
                                        env={**os.environ, "OUT": self.path("disk", "out"), "KEEP": keep})
                if "mount:" in result.stderr or "unshare:" in result.stderr:
                    self.skipTest("mounting is not permitted")
                found = os.path.join(keep, "out")
                names = set(os.listdir(found))
                self.assertFalse([name for name in names if name.endswith(".part")], names)
                if result.returncode == 0:
                    self.assertLessEqual({"manifest.json", "metrics.csv", "replay.html"}, names)
                    continue
                reached.add(kilobytes)
                self.assertEqual(result.returncode, 1)
                self.assertRegex(result.stderr, "(?m)^collektive: [^\n]*(No space left|Disk full|could not be)")
                self.assertNotIn("Usual causes", result.stderr)
                manifest = os.path.join(found, "manifest.json")
                if os.path.exists(manifest):
                    with open(manifest) as file:
                        self.assertNotEqual(json.load(file)["outcome"], "complete")
        self.assertTrue(reached, "at least one disk must have become full")

    def test_a_replay_that_fills_the_disk_keeps_an_earlier_record(self) -> None:
        self.change("lamps.json", '"metrics": true', '"record": true')
        result = collektive("run", self.path("project", "lamps.json"), "--out", self.path("out"))
        self.assertEqual(result.returncode, 0, result.stderr)
        record = self.path("out", "run.clkrec")
        os.makedirs(self.path("disk"))
        earlier, size = self.path("disk", "earlier.clkrec"), os.path.getsize(record)
        script = 'mount -t tmpfs -o size=$1 none "$2" && cp "$3" "$4" && shift 4 && { "$@"; code=$?; cmp "$RECORD" "$EARLIER" && exit $code; }; exit 99'
        result = subprocess.run(["unshare", "--mount", "sh", "-c", script, "sh", str(2 * size - 8000), self.path("disk"), record, earlier, COLLEKTIVE,
                                 "replay", record, "--out", earlier], capture_output=True, text=True, env={**os.environ, "RECORD": record, "EARLIER": earlier})
        if "mount:" in result.stderr or "unshare:" in result.stderr:
            self.skipTest("mounting is not permitted")
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertRegex(last_error(result), "cannot write the record .*No space left")

    def test_a_replay_whose_record_lacks_its_last_bytes_keeps_an_earlier_record(self) -> None:
        self.change("lamps.json", '"metrics": true', '"record": true')
        result = collektive("run", self.path("project", "lamps.json"), "--out", self.path("out"))
        self.assertEqual(result.returncode, 0, result.stderr)
        record, earlier = self.path("out", "run.clkrec"), self.path("earlier.clkrec")
        self.assertEqual(collektive("replay", record, "--out", earlier).returncode, 0)
        with open(earlier, "rb") as file:
            before = file.read()
        result = subprocess.run(["prlimit", f"--fsize={len(before) - 6}", COLLEKTIVE, "replay", record, "--out", earlier], capture_output=True, text=True)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertIn("cannot write the record", result.stderr)
        self.assertIn("the record of the replay is incomplete", last_error(result))
        with open(earlier, "rb") as file:
            self.assertEqual(file.read(), before)
