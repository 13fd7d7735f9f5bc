"""Tests that the project in the README is complete and short."""
import os

import pytest
from blocks import of_kind
from command import Folder, collektive

# A scene of ten nodes in a row, of which the first six sense more than 90. In Unity, users build this scene in the editor.
SCENE = """
using System.Collections.Generic;
using Collektive.Unity;
using swarm;
using UnityEngine;

public sealed class RowScene : SceneBuilder
{
    private readonly List<Node> nodes = new List<Node>();

    public override IReadOnlyList<string> MetricNames => new[] { "farthest", "coloured" };

    public override void Measure(double[] values)
    {
        values[0] = nodes[9].TryGetAnswer(out ActuatorData last) ? last.Hops : -1;
        values[1] = nodes[9].GetComponent<Renderer>().material.color == Color.HSVToRGB(0.2f, 1, 1) ? 1 : 0;
    }

    protected override void Build(SimulationManager manager)
    {
        for (var i = 0; i < 10; i++)
        {
            var body = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            body.transform.position = new Vector3(i + 4.5f, 0, 0);
            nodes.Add(body.AddComponent<Node>());
            body.AddComponent<LightSensor>();
            body.AddComponent<HopsColour>();
            if (i > 0) manager.AddLink(nodes[i - 1].Id, nodes[i].Id);
        }
    }
}
"""
SCENARIO = """{
  "version": 1, "scene": "RowScene", "scripts": "scripts", "schema": "swarm.fbs", "programs": "programs",
  "program": "hops-to-light", "seconds": 1, "deltaTime": 0.1, "outputs": { "metrics": true }
}"""


def project():
    """Returns the schema, program, sensor and actuator in the section "Example"."""
    return [block.text for block in of_kind("project") if block.page == "README.md"]


@pytest.mark.quick
class ReadmeTest(Folder):
    def test_the_example_has_at_most_25_handwritten_lines(self) -> None:
        # The count includes imports and braces, but not empty lines.
        lines = [line for block in project() for line in block.splitlines() if line.strip()]
        self.assertLessEqual(len(lines), 25, "\n".join(lines))

    def test_the_example_runs_unchanged(self) -> None:
        schema, program, sensor, actuator = project()
        files = {
            "swarm.fbs": schema, "programs/Hops.kt": program, "scripts/LightSensor.cs": sensor, "scripts/HopsColour.cs": actuator,
            "scripts/RowScene.cs": SCENE, "swarm.json": SCENARIO,
        }
        for name, text in files.items():
            os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
            with open(self.path(name), "w") as file:
                file.write(text)
        result = collektive("run", "swarm.json", "--out", self.path("out"), cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        # The nodes from 4.5 m to 9.5 m sense more than 90. The last node, at 13.5 m, is four links farther.
        self.assertEqual(self.manifest(self.path("out"))["end"], {"farthest": 4, "coloured": 1})
