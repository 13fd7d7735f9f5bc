"""Tests the commands and code samples in the documentation."""
import csv
import json
import os
import re

import pytest
from blocks import of_kind
from command import Folder, collektive

from build.places import ROOT


class GettingStarted(Folder):
    SCENE = """
using Collektive.Unity;
using UnityEngine;
using swarm;

public sealed class Example : SceneBuilder
{
    protected override void Build(SimulationManager manager)
    {
        for (var i = 0; i < 20; i++)
        {
            var node = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            node.transform.position = new Vector3(2 * i, 0, 0);
            node.AddComponent<Node>();
            node.AddComponent<RadiusNeighbourhood>();
            node.AddComponent<LightSensor>();
            node.AddComponent<HopsColour>();
        }
    }
}
"""
    KOTLIN = """
package swarm

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.share
import org.collektive.api.Device
import org.collektive.api.Parameter
import org.collektive.api.Program
"""

    def test_the_example_of_the_page_runs(self) -> None:
        """Runs the page's schema, Kotlin and C# in `SCENE`."""
        schema, kotlin, csharp = (block.text for block in of_kind("project") if block.page == "Documentation~/getting-started.md")
        os.makedirs(self.path("programs"))
        os.makedirs(self.path("scene"))
        scenario = {"version": 1, "scene": "Example", "scripts": "scene", "schema": "swarm.fbs", "programs": "programs",
                    "program": "hops-to-light", "seconds": 1}
        files = {"swarm.fbs": schema, "programs/Hops.kt": kotlin if "import " in kotlin else self.KOTLIN + kotlin, "scene/Example.cs": self.SCENE + csharp,
                 "swarm.json": json.dumps(scenario)}
        for name, text in files.items():
            with open(self.path(name), "w") as file:
                file.write(text)
        result = collektive("run", self.path("swarm.json"), "--out", self.path("out"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.manifest(self.path("out"))["nodes"], 20)

    @pytest.mark.slow
    def test_the_tutorial_for_the_editor_works(self) -> None:
        """Runs both programs of the page with its components, in a scene that equals the one that the reader builds."""
        scene = self.SCENE.replace("HopsColour>();", "SwarmMove>();\n            node.AddComponent<SwarmPosition>();")
        files = {block.title: block.text for block in of_kind("project") if block.page == "Documentation~/first-swarm-in-unity.md"}
        files["Assets/Swarm/Example.cs"] = scene.replace("RadiusNeighbourhood>()", "RadiusNeighbourhood>().Radius = 12")
        for name, text in files.items():
            os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
            with open(self.path(name), "w") as file:
                file.write(text)
        distances = {}
        for program in "gather", "climb":
            scenario = {"version": 1, "scene": "Example", "scripts": "Assets/Swarm", "schema": "Assets/Swarm/swarm.fbs", "programs": "Assets/Swarm/Programs",
                        "program": program, "seconds": 30, "metrics": {"distance": "avg(abs(x - 20))"}, "outputs": {"metrics": True}}
            with open(self.path(f"{program}.json"), "w") as file:
                json.dump(scenario, file)
            result = collektive("run", self.path(f"{program}.json"), "--out", self.path(program))
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(self.path(program, "metrics.csv")) as file:
                distances[program] = [float(row["distance"]) for row in csv.DictReader(file)][-1]
        # The nodes begin at 0 m, 2 m and so on up to 38 m, and the lamp is at 20 m.
        self.assertLess(distances["climb"], distances["gather"])
        self.assertLess(distances["climb"], 3)

    @pytest.mark.quick
    def test_pictures_and_links_of_the_page_exist(self) -> None:
        with open(os.path.join(ROOT, "README.md")) as file:
            text = file.read()
        for path in re.findall(r"\]\((?!https:)([^)#]+)", text) + re.findall(r"`((?:docs|unity)/[^`]*\.md)`", text):
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)), path)
