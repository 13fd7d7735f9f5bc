"""Runs ./collektive bench tick and scene for a short time, and checks the results that do not depend on the machine."""
import json
import os
import subprocess
import unittest
from typing import Any

from build import bench_scene
from build.places import ROOT

OUT = os.path.join(ROOT, "build/bench/test.json")
KEYS = ["name", "variant", "program", "topology", "nodes", "threads", "median_us", "p99_us", "min_us", "managed_bytes_per_tick", "jvm_bytes_per_tick"]


class BenchTick(unittest.TestCase):
    result: subprocess.CompletedProcess[str]
    whole: dict[str, Any]
    rows: list[dict[str, Any]]

    @classmethod
    def setUpClass(cls) -> None:
        command = [os.path.join(ROOT, "collektive"), "bench", "tick", "--quick", "--nodes", "12,500", "--out", OUT]
        cls.result = subprocess.run(command, capture_output=True, text=True)
        if cls.result.returncode != 0:
            raise AssertionError(cls.result.stderr)
        with open(OUT) as file:
            cls.whole = json.load(file)
        cls.rows = cls.whole["rows"]

    def test_the_file_has_the_expected_format(self) -> None:
        self.assertEqual(sorted(self.whole), ["machine", "rows"])
        self.assertTrue(self.whole["machine"])
        for row in self.rows:
            self.assertEqual(list(row), KEYS)

    def test_all_variants_are_measured(self) -> None:
        found = {(row["name"], row["variant"], row["nodes"]) for row in self.rows}
        for nodes in [12, 500]:
            for variant in ["in-process", "own-process", "per-node-call", "socket", "engine-only", "hand-written", "in-process, every 8 ms",
                            "socket, every 8 ms"]:
                self.assertIn(("tick", variant, nodes), found)
        self.assertIn(("crossing", "in-process", 0), found)
        self.assertIn(("spawn", "in-process", 500), found)

    def test_times_are_in_order(self) -> None:
        for row in self.rows:
            self.assertLess(0, row["min_us"], row)
            self.assertLessEqual(row["min_us"], row["median_us"], row)
            self.assertLessEqual(row["median_us"], row["p99_us"], row)

    def test_a_tick_allocates_no_managed_memory(self) -> None:
        for row in self.rows:
            if row["name"] in ("tick", "crossing") and row["variant"] in ("in-process", "own-process", "per-node-call", "in-process, every 8 ms"):
                self.assertEqual(row["managed_bytes_per_tick"], 0, row)

    def test_the_jvm_allocates_for_rounds_only(self) -> None:
        def bytes_of(variant: str) -> float:
            return next(float(row["jvm_bytes_per_tick"]) for row in self.rows if row["variant"] == variant and row["nodes"] == 500)
        self.assertLess(bytes_of("in-process"), bytes_of("engine-only") * 1.5 + 1000)

    def test_the_table_is_printed(self) -> None:
        for word in ["in-process", "hand-written", "bridge at 500 nodes", "managed bytes per tick, 500 nodes"]:
            self.assertIn(word, self.result.stdout)


class BenchScene(unittest.TestCase):
    OUT = os.path.join(ROOT, "build/bench/test-scene.json")
    result: subprocess.CompletedProcess[str]
    whole: dict[str, Any]

    @classmethod
    def setUpClass(cls) -> None:
        command = [os.path.join(ROOT, "collektive"), "bench", "scene", "--quick", "--nodes", "50,1000", "--out", cls.OUT]
        cls.result = subprocess.run(command, capture_output=True, text=True)
        if cls.result.returncode != 0:
            raise AssertionError(cls.result.stderr)
        with open(cls.OUT) as file:
            cls.whole = json.load(file)

    def test_the_file_has_a_row_for_each_size(self) -> None:
        self.assertEqual(sorted(self.whole), ["machine", "rows"])
        self.assertEqual([row["nodes"] for row in self.whole["rows"]], [50, 1000])
        for row in self.whole["rows"]:
            self.assertEqual(list(row), ["nodes", "threads", "ticks_per_second", "tick_ms_p99", "p99_to_mean", "queries_ms", "rules_ms", "sense_ms", "step_ms",
                                         "act_ms", "physics_ms", "other_ms", "rss_mb", "mean_distance", "in_c"])
            self.assertGreaterEqual(row["p99_to_mean"], 1, row)

    def test_the_phases_add_up_to_the_tick(self) -> None:
        for row in self.whole["rows"]:
            phases = [row[key] for key in row if key.endswith("_ms")]
            self.assertGreater(min(phases), 0, row)
            self.assertAlmostEqual(sum(phases) / (1000 / row["ticks_per_second"]), 1, places=2, msg=row)

    def test_the_loops_in_c_do_the_same_work(self) -> None:
        for row in self.whole["rows"]:
            self.assertGreater(min(row["in_c"].values()), 0, row)
            self.assertAlmostEqual(row["mean_distance"] / row["in_c"]["mean_distance"], 1, delta=0.1, msg=row)

    def test_larger_swarms_take_longer(self) -> None:
        small, large = self.whole["rows"]
        # The other phases wait for worker threads. Beside other suites, these waits take longer than the work.
        for phase in ("queries_ms", "act_ms"):
            self.assertLess(small[phase], large[phase], phase)

    def test_the_table_is_printed(self) -> None:
        for word in ["ticks/s", "physics ms", "other ms", "p99 ms", "p99/mean", "ms : in C", "RSS MB", "growth", "1000"]:
            self.assertIn(word, self.result.stdout)

    def test_invalid_sizes_are_rejected(self) -> None:
        for sizes in ["0", "ten", "500,"]:
            result = subprocess.run([os.path.join(ROOT, "collektive"), "bench", "scene", "--nodes", sizes], capture_output=True, text=True)
            self.assertEqual(result.returncode, 1)
            self.assertIn("--nodes needs numbers from 1 to 999999", result.stderr)


class SceneTable(unittest.TestCase):
    def test_times_that_are_rounded_to_zero_have_no_ratio(self) -> None:
        row = {"nodes": 1, "ticks_per_second": 2000.0, "tick_ms_p99": 1.0, "p99_to_mean": 2.0, "rss_mb": 90.0, **dict.fromkeys(bench_scene.PHASES, 0.1),
               "in_c": dict.fromkeys(bench_scene.BARE_PHASES, 0.0)}
        self.assertIn("0.50 : 0.00 = -", bench_scene.table([row]))
