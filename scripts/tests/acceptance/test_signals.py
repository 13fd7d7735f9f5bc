"""Tests that a signal to a command ends all processes of the command, and determines its exit code."""
import os
import signal
import subprocess
import time

import pytest
from command import Project, collektive, processes

from build.places import COLLEKTIVE

CODES = {signal.SIGINT: 130, signal.SIGTERM: 143}


class Signals(Project):
    def start(self):
        command = [COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out"), "--overwrite",
                   "--seconds", "1000000"]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def assert_ends(self, process, number):
        process.send_signal(number)
        began = time.monotonic()
        output = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, CODES[number], output)
        self.assertLess(time.monotonic() - began, 15)
        self.assertEqual(processes(self.folder), {})
        return output

    def await_line(self, process, words) -> None:
        for line in process.stderr:
            if words in line:
                return
        self.fail(f"the command ended before it wrote '{words}'")

    def await_metrics(self) -> None:
        self.wait_until(lambda: os.path.exists(self.path("out", "metrics.csv")))
        time.sleep(0.5)

    def test_a_run_ends_after_its_tick_with_its_outputs(self) -> None:
        for number in CODES:
            with self.subTest(number):
                process = self.start()
                self.await_metrics()
                self.assertIn("interrupted after", self.assert_ends(process, number))
                self.assertGreater(self.manifest(self.path("out"))["ticks"], 0)
                os.remove(self.path("out", "metrics.csv"))

    @pytest.mark.slow
    def test_a_signal_cancels_the_build_of_a_scene(self) -> None:
        self.change("scene/Lamps.cs", "Build(SimulationManager manager)\n        {", "Build(SimulationManager manager)\n        {\n"
                    "            System.Threading.Thread.Sleep(60000);")
        for number in CODES:
            with self.subTest(number):
                process = self.start()
                self.await_line(process, "running")
                time.sleep(1.5)
                self.assertIn("interrupted before the first tick", self.assert_ends(process, number))
                self.assertFalse(os.path.exists(self.path("out", "manifest.json")))

    def test_the_same_signal_from_two_processes_ends_the_run_after_its_tick(self) -> None:
        self.change("scene/Lamps.cs", "data.Brightness = Brightness;", "System.Threading.Thread.Sleep(50);\n            data.Brightness = Brightness;")
        process = self.start()
        self.await_metrics()
        # Slurm signals all processes of a job, and the command forwards its signal to the player.
        for pid in processes("Collektive.Player.exe", self.path("out")):
            os.kill(pid, signal.SIGTERM)
        time.sleep(0.1)
        self.assertIn("interrupted after", self.assert_ends(process, signal.SIGTERM))

    def test_a_second_signal_ends_an_endless_tick(self) -> None:
        self.change("scene/Lamps.cs", "data.Brightness = Brightness;",
                    "if (SimulationManager.Current.Tick == 0) System.Threading.Thread.Sleep(60000);\n            data.Brightness = Brightness;")
        process = self.start()
        self.await_metrics()
        process.send_signal(signal.SIGINT)
        time.sleep(1.5)
        self.assertIn("interrupted twice", self.assert_ends(process, signal.SIGINT))

    def test_a_signal_ends_compilers_and_the_next_run_compiles_again(self) -> None:
        with open(self.path("project", "programs", "Brightest.kt"), "a") as file:
            file.write(f"\n// {time.time_ns()}\n")
        for number in CODES:
            with self.subTest(number):
                process = self.start()
                self.await_line(process, "compile-programs")
                time.sleep(1)
                self.assert_ends(process, number)
        result = collektive("run", self.path("project", "lamps.json"), "--out", self.path("out"), "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)

    @pytest.mark.slow
    def test_an_interrupted_replay_leaves_no_files(self) -> None:
        self.change("lamps.json", '"metrics": true', '"record": true')
        result = collektive("run", self.path("project", "lamps.json"), "--out", self.path("out"), "--seconds", "2000")
        self.assertEqual(result.returncode, 0, result.stderr)
        os.mkdir(self.path("replays"))
        for number in CODES:
            with self.subTest(number):
                process = subprocess.Popen([COLLEKTIVE, "replay", self.path("out", "run.clkrec"), "--out", self.path("replays", "a.clkrec")],
                                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                self.wait_until(lambda: os.listdir(self.path("replays")))
                self.assert_ends(process, number)
                self.assertEqual(os.listdir(self.path("replays")), [])
