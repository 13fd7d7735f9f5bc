using System.Collections.Generic;
using System.Globalization;
using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>
    /// Two crowds walk in opposite directions along a street of 80 x 20 m, with pillars in the middle. Walkers within 5 m of each other exchange messages.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Crowd Scene")]
    public sealed class CrowdScene : SceneBuilder
    {
        private const int IgnoreRaycastLayer = 2;
        private const float BodyRadius = 0.25f;
        private const float HearingRange = 5;
        private const float Arrived = 1;
        private const float Front = 8;
        private const float Spacing = 1.8f;

        private static readonly string[] Names = { "arrived", "bumps", "warned", "density" };
        private static readonly float[] PillarPlaces = { -6, -2, 2, 6 };

        /// <summary>Number of walkers. Half of them start on each side.</summary>
        [Min(2)]
        public int walkers = 160;

        /// <summary>Density in walkers per square metre above which walkers are warned.</summary>
        [Min(0)]
        public float limit = 0.9f;

        private readonly List<BumpSensor> bumps = new List<BumpSensor>();
        private readonly List<GoalSensor> goals = new List<GoalSensor>();
        private PhysicsMaterial slippery;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <inheritdoc/>
        public override IReadOnlyList<NodeColouring> Colourings => new[]
        {
            new NodeColouring("density", node => node.TryGetAnswer(out ActuatorData answer) ? answer.Density : 0) { Unit = "walkers/m²" },
            new NodeColouring("warning", node => node.TryGetAnswer(out ActuatorData answer) && answer.Warned ? 1 : 0)
            {
                IsCategory = true, Categories = new[] { "not warned", "warned" },
            },
        };

        /// <summary>
        /// Writes the number of walkers at their goals, the number of rounds with a collision, the number of warned walkers, and the greatest density in
        /// walkers per square metre.
        /// </summary>
        public override void Measure(double[] values)
        {
            System.Array.Clear(values, 0, values.Length);
            for (var i = 0; i < goals.Count; i++)
            {
                var way = goals[i].Goal - goals[i].transform.position;
                way.y = 0;
                if (way.magnitude < Arrived) values[0]++;
                values[1] += bumps[i].Rounds;
                if (!goals[i].Node.TryGetAnswer(out ActuatorData answer)) continue;
                if (answer.Warned) values[2]++;
                values[3] = System.Math.Max(values[3], answer.Density);
            }
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            if (walkers < 2 || walkers > 300)
            {
                manager.Fail("the scene has " + walkers + " walkers: use 2 to 300");
                return;
            }
            slippery = new PhysicsMaterial { dynamicFriction = 0, staticFriction = 0, bounciness = 0, frictionCombine = PhysicsMaterialCombine.Minimum };
            MakeObstacle("Floor", new Vector3(0, -0.5f, 0), new Vector3(80, 1, 21)).layer = IgnoreRaycastLayer;
            MakeObstacle("Wall", new Vector3(0, 1, 10.25f), new Vector3(80, 2, 0.5f));
            MakeObstacle("Wall", new Vector3(0, 1, -10.25f), new Vector3(80, 2, 0.5f));
            foreach (var place in PillarPlaces) MakeObstacle("Pillar", new Vector3(0, 1, place), new Vector3(1, 2, 1));
            var rows = (walkers + 19) / 20;
            for (var i = 0; i < walkers; i++)
            {
                // On each side, walkers start in rows of ten near the middle, with small random offsets.
                var side = i % 2 == 0 ? -1 : 1;
                var place = new Vector3(side * (Front + Spacing * (i / 20)), BodyRadius, Spacing * (i / 2 % 10 - 4.5f));
                place += new Vector3(manager.Random.Range(-0.3f, 0.3f), 0, manager.Random.Range(-0.3f, 0.3f));
                MakeWalker(place, place - side * (2 * Front + Spacing * (rows - 1)) * Vector3.right);
            }
        }

        private GameObject MakeObstacle(string title, Vector3 centre, Vector3 size)
        {
            var box = MakeBox(title, centre, size);
            box.GetComponent<Collider>().sharedMaterial = slippery;
            return box;
        }

        private void MakeWalker(Vector3 place, Vector3 target)
        {
            var walker = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            walker.SetActive(false);
            walker.name = "Walker";
            walker.layer = IgnoreRaycastLayer;
            walker.transform.position = place;
            walker.transform.localScale = 2 * BodyRadius * Vector3.one;
            walker.GetComponent<Collider>().sharedMaterial = slippery;
            walker.AddComponent<Rigidbody>().constraints = RigidbodyConstraints.FreezeRotation;
            walker.AddComponent<Node>().Parameters.Add(new NodeParameter("limit", limit.ToString(CultureInfo.InvariantCulture)));
            walker.AddComponent<RadiusNeighbourhood>().Radius = HearingRange;
            walker.AddComponent<PositionSensor>();
            var goal = walker.AddComponent<GoalSensor>();
            goal.Goal = target;
            goals.Add(goal);
            walker.AddComponent<WallSensor>().Reach = 2;
            bumps.Add(walker.AddComponent<BumpSensor>());
            walker.AddComponent<WalkActuator>().KeepVertical = true;
            walker.AddComponent<WarningColour>();
            walker.SetActive(true);
        }
    }
}
