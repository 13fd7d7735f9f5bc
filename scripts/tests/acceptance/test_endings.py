"""Tests that exit code 0 means that all ticks were done."""
import csv
import os
import signal
import socket
import subprocess
import time
from pathlib import Path

import pytest
import replay
from command import Project, collektive, compiled, jdk, last_error, processes

from build import managed, player
from build.places import COLLEKTIVE


class WholeRuns(Project):
    """Tests runs that end early, in different ways."""

    SCRIPT = """
        private void Update()
        {
            var manager = SimulationManager.Current;
            if (manager != null && manager.Tick == 4) { %s }
        }

        protected override void Build("""

    def run_it(self, *arguments, **environment):
        return subprocess.run([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out"), "--overwrite", *arguments],
                              capture_output=True, text=True, env={**os.environ, **environment}, cwd=self.folder)

    def at_tick_4(self, code):
        self.change("scene/Lamps.cs", "\n        protected override void Build(", self.SCRIPT % code)
        return self.run_it()

    def test_a_user_without_a_home_runs_without_the_class_archive(self) -> None:
        result = self.run_it(HOME="/proc")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("without its class archive", result.stdout + result.stderr)
        self.assertEqual(self.manifest(self.path("out"))["ticks"], 10)

    def test_an_unknown_program_is_rejected_before_compilation(self) -> None:
        self.change("programs/Brightest.kt", "val mine", "val mine = ")
        result = self.run_it("--set", "program=brigthest")
        self.assertEqual(result.returncode, 1)
        self.assertIn("unknown program 'brigthest'; '", last_error(result))
        self.assertIn("contains brightest", last_error(result))

    def test_invalid_durations_and_time_steps_are_rejected(self) -> None:
        for old, new, words in [
            ('"seconds": 1', '"seconds": 3e8', ["seconds", "3E+09 ticks", "100 million"]),
            ('"seconds": 1', '"seconds": NaN', ["greater than 0"]),
            ('"seconds": 1', '"seconds": Infinity', ["greater than 0"]),
            ('"seconds": 1', '"seconds": -1', ["greater than 0"]),
            ('"deltaTime": 0.1', '"deltaTime": 1e-30', ["delta time is 1E-30 s", "at least"]),
            ('"deltaTime": 0.1', '"deltaTime": NaN', ["delta time"]),
            ('"deltaTime": 0.1', '"deltaTime": -1', ["delta time"]),
            ('"threads": 2', '"physicsStep": 1e-30', ["physics step"]),
        ]:
            with self.subTest(new):
                self.change("lamps.json", old, new)
                result = self.run_it()
                self.change("lamps.json", new, old)
                self.assertEqual(result.returncode, 1, result.stderr)
                for word in words:
                    self.assertIn(word, last_error(result))
        result = self.run_it("--seconds", "3e8")
        self.assertEqual(result.returncode, 1)
        self.assertIn("100 million", last_error(result))

    def test_an_exception_in_a_callback_is_an_error(self) -> None:
        result = self.at_tick_4('throw new System.InvalidOperationException("deliberate");')
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("1 errors", last_error(result))
        manifest = self.manifest(self.path("out"))
        self.assertEqual((manifest["ticks"], manifest["errors"]), (10, 1))

    def test_an_initialiser_with_parameters_is_reported(self) -> None:
        self.change("scene/Lamps.cs", "\n        protected override void Build(",
                    "\n        [RuntimeInitializeOnLoadMethod] private static void Begin(int seed) { }\n\n        protected override void Build(")
        result = self.run_it()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("'Lamps.LampScene.Begin' with [RuntimeInitializeOnLoadMethod] is not called, because it has parameters", result.stderr)

    def test_a_replay_ends_at_the_end_of_the_run(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        self.change("lamps.json", '"deltaTime": 0.1', '"deltaTime": 0.03')
        result = self.run_it("--seconds", "0.3")
        self.assertEqual(result.returncode, 0, result.stderr)
        _, frames, _ = replay.read(self.path("out", "replay.html"))
        self.assertEqual([round(time, 2) for time, _ in frames], [0, 0.12, 0.24, 0.3])

    @pytest.mark.slow
    def test_seeds_have_64_bits_in_files_on_the_command_line_and_in_records(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "record": true, "replay": true')
        for seed in [2**63 - 1, 2**63, 2**64 - 1]:
            self.change("lamps.json", '"threads": 2', f'"threads": 2, "seed": {seed}')
            self.assertEqual(self.run_it().returncode, 0)
            self.change("lamps.json", f'"threads": 2, "seed": {seed}', '"threads": 2')
            in_file = self.manifest(self.path("out"))
            self.assertEqual(self.run_it("--seed", str(seed)).returncode, 0)
            self.assertEqual(in_file["scenario"]["seed"], seed)
            self.assertEqual(self.manifest(self.path("out"))["scenario"], in_file["scenario"])
            self.assertEqual(replay.read(self.path("out", "replay.html"))[0]["seed"], str(seed))
            self.assertIn(f"seed {seed},", collektive("replay", self.path("out", "run.clkrec")).stdout)
        for seed in ["18446744073709551616", "-1", "1.5"]:
            self.change("lamps.json", '"threads": 2', f'"threads": 2, "seed": {seed}')
            for result in [self.run_it(), self.run_it("--seed", seed)]:
                self.assertEqual(result.returncode, 1)
                self.assertIn("seed", last_error(result))
                self.assertIn("2^64 - 1", last_error(result))
            self.change("lamps.json", f'"threads": 2, "seed": {seed}', '"threads": 2')

    def test_a_run_whose_manager_was_paused_or_disabled_is_incomplete(self) -> None:
        for code, cause in [("manager.Paused = true;", "paused the Simulation Manager"), ("manager.enabled = false;", "disabled the Simulation Manager"),
                            ("Destroy(manager);", "destroyed the Simulation Manager"), ("Time.timeScale = 0;", "set Time.timeScale to 0")]:
            with self.subTest(code):
                result = self.at_tick_4(code)
                self.change("scene/Lamps.cs", self.SCRIPT % code, "\n        protected override void Build(")
                self.assertEqual(result.returncode, 1)
                self.assertIn(f"4 of 10 ticks were completed: a script {cause}; ", last_error(result))
                self.assertEqual(self.manifest(self.path("out"))["ticks"], 4)

    def test_a_disabled_manager_after_the_last_tick_and_two_ticks_in_a_frame_are_errors(self) -> None:
        self.change("scene/Lamps.cs", "if (loop) ", """manager.Ticked += all =>
            {
                all.enabled = loop || all.Tick < 10;
                if (loop && all.Tick == 4) Time.timeScale = 2;
            };
            if (loop) """)
        for setting, message in [("loop=false", "10 of 10 ticks were completed: a script disabled the Simulation Manager; "),
                                 ("loop=true", "stopped at tick 6: a frame ran more than one tick; do not set Time.timeScale above 1 or call Step ")]:
            with self.subTest(setting):
                result = self.run_it("--set", setting)
                self.assertEqual(result.returncode, 1)
                self.assertIn(message, last_error(result))
                with open(self.path("out", "metrics.csv")) as file:
                    self.assertEqual([row["second"] for row in csv.DictReader(file)], ["0"])

    def test_two_ticks_in_a_frame_after_a_frame_without_a_tick_are_an_error(self) -> None:
        script = self.SCRIPT.replace("if (manager != null && manager.Tick == 4)", "if (Time.frameCount > 5)")
        code = "Time.timeScale = Time.frameCount == 6 ? 0 : Time.frameCount == 7 ? 2 : 1;"
        self.change("scene/Lamps.cs", "\n        protected override void Build(", script % code)
        result = self.run_it()
        self.assertEqual(result.returncode, 1)
        self.assertIn("stopped at tick 8: a frame ran more than one tick; ", last_error(result))

    def test_a_manager_can_be_enabled_again_only_before_the_first_tick(self) -> None:
        at_start = self.SCRIPT.replace("Update", "Start").replace("Tick == 4", "Tick == 0")
        for script, code, error in [(self.SCRIPT, 1, "stopped after tick 4: a script disabled and enabled the Simulation Manager, "), (at_start, 0, "")]:
            with self.subTest(code):
                script %= "manager.enabled = false; manager.enabled = true;"
                self.change("scene/Lamps.cs", "\n        protected override void Build(", script)
                result = self.run_it("--set", "metrics.bytes=total(message_bytes)")
                self.change("scene/Lamps.cs", script, "\n        protected override void Build(")
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertIn(error, result.stderr)
        manifest = self.manifest(self.path("out"))
        self.assertIn("brightest", manifest["parameters"])
        self.assertGreater(manifest["end"]["bytes"], 0)

    @pytest.mark.slow
    def test_ticks_can_be_up_to_an_hour_long(self) -> None:
        for schedule, seconds in [("Lockstep", 3600), ("Sequential", 60), ("Asynchronous", 0.34)]:
            with self.subTest(f"{schedule}, {seconds} s"):
                timing = ["--set", f'timing={{"period": {seconds}}}'] if schedule == "Asynchronous" else []
                result = self.run_it("--set", f"deltaTime={seconds}", "--set", f"schedule={schedule}", *timing, "--seconds", str(3 * seconds))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(self.manifest(self.path("out"))["ticks"], 3)

    def test_a_stop_condition_or_quit_completes_a_run(self) -> None:
        for code, ticks in [("manager.StopCondition = all => true;", 5), ("Application.Quit(0);", 4)]:
            with self.subTest(code):
                result = self.at_tick_4(code)
                self.change("scene/Lamps.cs", self.SCRIPT % code, "\n        protected override void Build(")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(self.manifest(self.path("out"))["ticks"], ticks)

    def test_tables_and_records_that_are_deleted_during_the_run_are_an_error(self) -> None:
        table = self.path("out", "metrics.csv")
        for code in (f'System.IO.File.Delete("{table}");', f'System.IO.File.Copy("{table}", "{table}.new"); System.IO.File.Delete("{table}"); '
                     f'System.IO.File.Move("{table}.new", "{table}");'):
            with self.subTest(code):
                result = self.at_tick_4(code)
                self.change("scene/Lamps.cs", self.SCRIPT % code, "\n        protected override void Build(")
                self.assertEqual(result.returncode, 1)
                self.assertIn("metrics.csv' was moved, deleted or replaced during the run", last_error(result))
                self.assertTrue(self.manifest(self.path("out"))["outcome"].startswith("failed: "))
        self.change("lamps.json", '"metrics": true', '"metrics": true, "record": true')
        result = self.at_tick_4(f'System.IO.File.Delete("{self.path("out", "run.clkrec")}");')
        self.assertEqual(result.returncode, 1)
        self.assertIn("run.clkrec' was moved or deleted during the run", last_error(result))

    def test_a_run_keeps_the_files_of_another_run_that_replaced_its_folder(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "replay": true')
        out, other = self.path("out"), self.path("other")
        os.mkdir(other)
        names = ("manifest.json", "manifest.json.part", "metrics.csv", "replay.html", "replay.tmp")
        for name in names:
            with open(os.path.join(other, name), "w") as file:
                file.write("other")
        result = self.at_tick_4(f'System.IO.Directory.Move("{out}", "{out}.moved"); System.IO.Directory.Move("{other}", "{out}");')
        self.assertEqual(result.returncode, 1)
        self.assertIn("out' was moved, deleted or replaced during the run", last_error(result))
        for name in names:
            with open(os.path.join(out, name)) as file:
                self.assertEqual(file.read(), "other")

    def test_the_exit_code_of_a_script_is_returned(self) -> None:
        for code, expected in [(3, 3), (256, 1)]:
            with self.subTest(code):
                result = self.at_tick_4(f"Application.Quit({code});")
                self.change("scene/Lamps.cs", self.SCRIPT % f"Application.Quit({code});", "\n        protected override void Build(")
                self.assertEqual(result.returncode, expected, result.stderr)

    def test_a_run_with_errors_that_a_script_ends_fails(self) -> None:
        result = self.at_tick_4('Application.Quit(0); throw new System.Exception("lost");')
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("the run ended, but 1 errors occurred", last_error(result))

    def test_a_recorded_run_can_end_before_its_first_tick(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "record": true')
        self.change("scene/Lamps.cs", "if (loop) ", "Application.Quit(3); if (loop) ")
        result = self.run_it()
        self.assertEqual(result.returncode, 3, result.stderr)

    def fails_at_tick_4(self, code):
        """Runs a script that executes the code at tick 4. Checks that the run is incomplete, and returns its result with the messages."""
        result = self.at_tick_4(code)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertNotEqual(self.manifest(self.path("out"))["outcome"], "complete")
        return result

    def test_a_run_whose_script_ends_the_process_is_incomplete(self) -> None:
        self.assertIn("the player exited with code 0 during the run. Usual causes: ", last_error(self.fails_at_tick_4("System.Environment.Exit(0);")))

    @pytest.mark.slow
    def test_a_run_whose_jvm_crashes_is_incomplete(self) -> None:
        self.change("programs/Brightest.kt", "val mine = sensors.brightness()",
                    'val mine = sensors.brightness()\n'
                    '    val field = Class.forName("sun.misc.Unsafe").getDeclaredField("theUnsafe").apply { isAccessible = true }\n'
                    '    if (sensors.brightness() == 3f) (field.get(null) as sun.misc.Unsafe).putAddress(0, 0)')
        before = set(os.listdir(self.folder)) | {"out"}
        result = self.run_it()
        self.assertNotEqual(result.returncode, 0)
        self.assertNotEqual(self.manifest(self.path("out"))["outcome"], "complete")
        self.assertEqual(set(os.listdir(self.folder)), before)

    @pytest.mark.slow
    def test_endless_recursion_in_a_script_is_reported(self) -> None:
        self.change("scene/Lamps.cs", "data.Brightness = Brightness;", "data.Brightness = SimulationManager.Current.Tick == 4 ? Deep(0) : Brightness;")
        self.change("scene/Lamps.cs", "        protected override void Sense(", """
        private int Deep(int depth) => new object[1000].Length + Deep(depth + 1);

        protected override void Sense(""")
        result = self.run_it()
        # Mono exits with 1. If the stack overflows in Mono's own code, a signal ends the process.
        self.assertIn(result.returncode, (1, 128 + signal.SIGSEGV))
        self.assertIn(f"the player exited with code {result.returncode} during the run. Usual causes: infinite recursion in a script,", last_error(result))
        self.assertEqual(self.manifest(self.path("out"))["outcome"], "running")

    def test_a_debugger_can_stop_a_run_longer_than_the_step_limit(self) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = str(free.getsockname()[1])
        run = subprocess.Popen([COLLEKTIVE, "run", self.path("project", "lamps.json"), "--out", self.path("out"), "--debug", port, "--set", "stepLimitMs=100"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while "waiting for a debugger on 127.0.0.1:" + port not in run.stderr.readline():
            self.assertIsNone(run.poll())
        debugger = subprocess.Popen([jdk() + "/bin/jdb", "-attach", "127.0.0.1:" + port], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        debugger.stdin.write("stop in lamps.BrightestKt.brightest\n")
        debugger.stdin.flush()
        while "Breakpoint hit" not in debugger.stdout.readline():
            self.assertIsNone(debugger.poll())
        time.sleep(1)
        debugger.communicate("print sensors.brightness()\nclear lamps.BrightestKt.brightest\ncont\nquit\n")
        self.assertEqual(run.wait(60), 0, run.stderr.read())
        self.assertEqual(self.manifest(self.path("out"))["ticks"], 10)

    def test_a_live_run_ends_without_an_error_if_its_connection_is_closed(self) -> None:
        scenario = self.path("project", "lamps.json")
        plan = player.plan(scenario, [])
        jar, dll = (Path(compiled(compile_part)) for compile_part in (plan.programs_jar, plan.scripts_dll))
        own_end, player_end = socket.socketpair()
        with player_end:
            command = player.command("live", scenario, plan, jar, dll, Path(jdk()), ["--out", self.folder, "--channel", str(player_end.fileno())])
            run = subprocess.Popen(command, env=managed.environment("mono-sgen"), stderr=subprocess.PIPE, text=True, pass_fds=[player_end.fileno()])
        own_end.recv(1)
        # The paused run sends nothing, so only its reader notices that the connection is closed before the other messages are received.
        own_end.sendall(b'{"run": false}\n')
        time.sleep(1)
        own_end.close()
        self.assertEqual(run.communicate(timeout=60)[1], "")
        self.assertEqual(run.returncode, 1)

    def test_threads_and_processes_of_a_script_do_not_outlive_the_run(self) -> None:
        began = time.monotonic()
        result = self.at_tick_4('new System.Threading.Thread(() => System.Threading.Thread.Sleep(600000)).Start(); '
                                f'System.Diagnostics.Process.Start("sh", "-c \'setsid sleep 600; : {self.folder}/\'");')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(time.monotonic() - began, 60)
        self.assertEqual(processes(self.folder + "/"), {})

    @pytest.mark.slow
    def test_csharp_that_does_not_return_exceeds_the_step_limit(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, "stepLimitMs": 700')
        caught = "try { System.Threading.Thread.Sleep(100); } catch (System.Exception) { System.Threading.Thread.ResetAbort(); }"
        for code in ["while (true) { }", f"while (true) {{ {caught} }}"]:
            with self.subTest(code):
                line = f"if (SimulationManager.Current.Tick == 4) {{ {code} }}\n            data.Brightness = Brightness;"
                self.change("scene/Lamps.cs", "data.Brightness = Brightness;", line)
                result = self.run_it()
                self.change("scene/Lamps.cs", line, "data.Brightness = Brightness;")
                self.assertEqual(result.returncode, 1, result.stderr)
                message = "stopped at tick 5: sensors, actuators, rules or scripts exceeded 'stepLimitMs', 700 ms"
                self.assertIn(message, last_error(result))
                self.assertEqual(self.manifest(self.path("out"))["outcome"], "failed: " + message)

    def test_a_metric_of_the_scene_that_does_not_return_exceeds_the_step_limit(self) -> None:
        self.change("lamps.json", '"threads": 2', '"threads": 2, "stepLimitMs": 700')
        for tick in [0, 10]:
            with self.subTest(tick=tick):
                line = f"public override void Measure(double[] values)\n        {{\n            while (SimulationManager.Current.Tick == {tick}) {{ }}"
                self.change("scene/Lamps.cs", "public override void Measure(double[] values)\n        {", line)
                result = self.run_it()
                self.change("scene/Lamps.cs", line, "public override void Measure(double[] values)\n        {")
                self.assertEqual(result.returncode, 1, result.stderr)
                message = f"stopped at tick {tick}: the metrics of the scene exceeded 'stepLimitMs', 700 ms"
                self.assertIn(message, last_error(result))
                self.assertEqual(self.manifest(self.path("out"))["outcome"], "failed: " + message)

    def test_long_runs_have_all_rows(self) -> None:
        self.change("lamps.json", '"metrics": true', '"metrics": true, "nodes": { "fields": ["position"] }')
        self.change("lamps.json", '"deltaTime": 0.1', '"deltaTime": 0.02, "converged": { "agreeing": { "from": 10, "seconds": 48 } }')
        result = self.run_it("--seconds", "50")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("out", "metrics.csv")) as file:
            self.assertEqual([row["second"] for row in csv.DictReader(file)], [str(second) for second in range(51)])
        with open(self.path("out", "nodes.csv")) as file:
            self.assertEqual(len(list(csv.DictReader(file))), 51 * 10)
        self.assertEqual(self.manifest(self.path("out"))["converged"], {"agreeing": 1})

    def test_rows_have_the_time_of_their_tick(self) -> None:
        self.change("lamps.json", '"metrics": true', '"interval": 1, "nodes": { "fields": ["position"] }')
        self.change("lamps.json", '"deltaTime": 0.1', '"deltaTime": 0.3, "converged": { "agreeing": { "from": 10 } }')
        # Three ticks of 0.3333333 count as an interval of 1 s, although their sum is below 1. This must hold for later intervals, too.
        for ticks, times in [("0.3", [0, 1.2, 2.1, 3, 4.2, 5.1, 6]), ("0.3333333333", [0, 1, 2, 3, 4, 5, 5.999999])]:
            result = self.run_it("--seconds", "6", "--set", f"deltaTime={ticks}")
            self.assertEqual(result.returncode, 0, result.stderr)
            for name in ["metrics.csv", "nodes.csv"]:
                with open(self.path("out", name)) as file:
                    found = {float(row["second"]): None for row in csv.DictReader(file)}
                self.assertEqual(list(found), times)
            self.assertIn(self.manifest(self.path("out"))["converged"]["agreeing"], times)

    @pytest.mark.slow
    def test_a_metric_with_the_name_of_a_column_is_rejected(self) -> None:
        for name in ["seen", "links", "second"]:
            self.change("scene/Lamps.cs", '"agreeing"', f'"{name}"')
            result = self.run_it()
            self.change("scene/Lamps.cs", f'{{ "{name}"', '{ "agreeing"')
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"has the metric '{name}', but metrics.csv already has a column of that name: rename the metric", last_error(result))
            self.assertFalse(os.path.exists(self.path("out", "metrics.csv")))

    @pytest.mark.slow
    def test_malformed_field_values_are_rejected(self) -> None:
        for value in ["0,5", "010", "0x10", "1 2", "[1", ""]:
            result = self.run_it("--set", f"lamps={value}")
            self.assertEqual(result.returncode, 1, value)
            self.assertIn(f"--set lamps={value}: it must be of type whole number", last_error(result))
