"""Tests that each sample behaves as its page describes."""
import csv
import json
import math
import os
import shutil

import pytest
import replay
from command import SAMPLE, Folder, collektive


class SamplesTest(Folder):
    """Runs the scenario of each sample without writing a replay."""

    def rows(self, sample, **changes):
        """Runs a sample with some keys of its scenario changed, and returns the metrics of each second."""
        shutil.copytree(os.path.dirname(SAMPLE), self.path("samples"))
        path = self.path("samples", sample, "scenario.json")
        with open(path) as file:
            scenario = json.load(file)
        scenario["outputs"] = changes.pop("outputs", {})
        scenario["fields"].update(changes.pop("fields", {}))
        scenario.update(changes)
        scenario["programs"] = os.path.normpath(os.path.join(SAMPLE, scenario["programs"]))
        with open(path, "w") as file:
            json.dump(scenario, file)
        result = collektive("run", path, "--out", self.path("out"), "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("out", "metrics.csv")) as file:
            return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def under_each_schedule(self, sample, **changes):
        """Yields each schedule with the metrics. With the asynchronous schedule, a quarter of the nodes is due in each tick."""
        for schedule in ["Lockstep", "Sequential", "Asynchronous"]:
            yield schedule, self.rows(sample, schedule=schedule, timing={"period": 4 * changes.get("deltaTime", 0.1)}, **changes)
            shutil.rmtree(self.path("samples"))

    @pytest.mark.slow
    def test_the_leader_election_counts_all_nodes_under_each_schedule(self) -> None:
        for schedule, rows in self.under_each_schedule("LeaderElection", seconds=15, fields={"failAfter": 1000}):
            self.assertEqual(rows[-1]["led"], 400, schedule)

    @pytest.mark.slow
    def test_the_channel_is_connected_and_its_replay_does_not_flicker_under_each_schedule(self) -> None:
        for schedule, rows in self.under_each_schedule("Channel", seconds=15, fields={"failAfter": 1000}, outputs={"replay": True}):
            self.assertEqual(rows[-1]["connected"], 1, schedule)
            self.assertTrue(90 <= rows[-1]["length"] <= 125, schedule)
            _, frames, _ = replay.read(self.path("out", "replay.html"))
            # Every frame must show the whole channel, including nodes that were not due.
            shown = {sum(shade == 1 for *_, shade in nodes.values()) for _, nodes in frames[-5:]}
            self.assertEqual(shown, {rows[-1]["channel_nodes"]}, schedule)

    @pytest.mark.slow
    def test_all_walkers_compute_the_density_under_each_schedule(self) -> None:
        for schedule, rows in self.under_each_schedule("Crowd", seconds=5, fields={"walkers": 60}, outputs={"replay": True}):
            _, frames, _ = replay.read(self.path("out", "replay.html"))
            for _, nodes in frames[-5:]:
                self.assertEqual([node for node, (*_, density) in nodes.items() if density == 0], [], schedule)
            self.assertAlmostEqual(max(density for *_, density in frames[-1][1].values()), rows[-1]["density"], 3, schedule)

    @pytest.mark.slow
    def test_the_swarm_approaches_the_source_under_each_schedule(self) -> None:
        for schedule, rows in self.under_each_schedule("GradientAscent", seconds=10, deltaTime=0.05, fields={"nodes": 80}):
            self.assertLess(rows[-1]["mean_distance"], rows[0]["mean_distance"] - 3, schedule)

    @pytest.mark.slow
    def test_the_drones_form_each_shape_even_if_their_leader_fails(self) -> None:
        rows = self.rows("Swarm", seconds=24, fields={"drones": 300, "shapeSeconds": 8, "failAfter": 10})
        # These rows are just before each change of the shape. The leader fails during the second shape.
        for row in rows[7], rows[15], rows[23]:
            self.assertGreater(row["formed"], 0.9 * 299, row)
            self.assertEqual(row["shapes"], 1, row)
        self.assertTrue(math.isnan(rows[0]["nearest"]), "no distance is known before the first tick")
        self.assertGreater(min(row["nearest"] for row in rows[1:]), 0.1, "drones must not overlap")

    def test_all_nodes_have_a_nearby_leader_even_after_leaders_fail(self) -> None:
        rows = self.rows("LeaderElection")
        before, after = rows[9], rows[-1]
        self.assertEqual(before["led"], 400)
        self.assertTrue(4 <= before["regions"] <= 40, before["regions"])
        rest = 400 - before["regions"]
        self.assertLess(rows[10]["led"], rest, "the number of nodes with a leader must drop when the leaders fail")
        self.assertEqual(after["led"], rest)
        for row in before, after:
            self.assertTrue(0 < row["farthest"] <= 20, row["farthest"])

    @pytest.mark.slow
    def test_the_channel_avoids_walls_and_failed_nodes(self) -> None:
        rows = self.rows("Channel")
        before, after = rows[9], rows[-1]
        for row in before, after:
            self.assertEqual(row["connected"], 1)
            self.assertLess(row["channel_nodes"], 200, "only some of the 600 nodes may be in the channel")
        # The straight path is 90 m long. The paths around the near and the far ends of the walls are 98 m and 107 m long.
        self.assertTrue(98 <= before["length"] <= 115, before["length"])
        self.assertTrue(107 <= after["length"] <= 125, after["length"])

    @pytest.mark.slow
    def test_the_robots_find_all_casualties_and_stay_connected_if_some_fail(self) -> None:
        rows = self.rows("Rescue")
        self.assertEqual(rows[59]["found"], 3)
        self.assertEqual(rows[59]["connected"], 3)
        self.assertLess(rows[59]["channel_robots"], 60, "only some of the 120 robots may be in channels")
        self.assertEqual(rows[-1]["robots"], 108)
        self.assertEqual(rows[-1]["connected"], 3)

    @pytest.mark.slow
    def test_the_explored_share_does_not_depend_on_the_interval_of_rows(self) -> None:
        shares = set()
        for interval in 0.1, 5:
            shares.add(self.rows("Rescue", seconds=15, outputs={"interval": interval})[-1]["explored"])
            shutil.rmtree(self.path("samples"))
        self.assertEqual(len(shares), 1, shares)

    @pytest.mark.slow
    def test_the_crowds_pass_with_few_collisions_and_warnings_end(self) -> None:
        rows = self.rows("Crowd")
        self.assertEqual(rows[-1]["arrived"], 160)
        # This is the number of collisions of 160 walkers in 1,200 rounds.
        self.assertLess(rows[-1]["bumps"], 100)
        self.assertGreater(max(row["warned"] for row in rows), 20, "many walkers must be warned where the groups meet")
        self.assertEqual(rows[-1]["warned"], 0)

    @pytest.mark.slow
    def test_each_sample_has_the_same_digest_in_both_placements_of_the_jvm(self) -> None:
        for sample in ["Channel", "Crowd", "GradientAscent", "LeaderElection", "Rescue", "Swarm"]:
            digests = set()
            for placement in ["InProcess", "OwnProcess"]:
                self.rows(sample, seconds=1, jvm={"placement": placement})
                with open(self.path("out", "manifest.json")) as file:
                    digests.add(json.load(file)["digest"])
                shutil.rmtree(self.path("samples"))
            self.assertEqual(len(digests), 1, sample)
