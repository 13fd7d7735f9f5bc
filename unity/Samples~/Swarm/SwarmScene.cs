using System.Collections.Generic;
using System.Globalization;
using Collektive.Unity;
using drones;
using UnityEngine;

namespace CollektiveSamples.Swarm
{
    /// <summary>
    /// Drones start from a square on the ground and form one shape after another in the air. One of them is the leader. It chooses the shape, and the choice
    /// spreads through the swarm from neighbour to neighbour. After a while, the leader fails, and another drone replaces it.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Swarm Scene")]
    public sealed class SwarmScene : SceneBuilder
    {
        private const float Spacing = 1.8f;
        private const float Pad = 1.2f;
        private const float Near = 2.5f;
        private const float InPlace = 1;

        private static readonly string[] ShapeNames = { "sphere", "ring", "wave", "letters" };
        private static readonly string[] Names = { "formed", "shapes", "nearest" };

        /// <summary>Number of drones.</summary>
        [Min(1)]
        public int drones = 10000;

        /// <summary>Simulated seconds from one shape to the next.</summary>
        [Min(1)]
        public float shapeSeconds = 18;

        /// <summary>Simulated seconds after which the leader fails.</summary>
        [Min(0)]
        public float failAfter = 20;

        /// <summary>Maximum speed in metres per second.</summary>
        [Min(0.1f)]
        public float speed = 12;

        [SerializeField]
        [Tooltip("Renderer that is drawn once per drone. Its material must have instancing enabled.")]
        private Renderer droneModel = null;

        private readonly List<Node> near = new List<Node>();
        private readonly List<float> distances = new List<float>();
        private readonly HashSet<int> formed = new HashSet<int>();
        private SimulationManager manager;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <inheritdoc/>
        public override IReadOnlyList<NodeColouring> Colourings => new[]
        {
            new NodeColouring("height", node => node.transform.position.y) { Unit = "m" },
            new NodeColouring("shape", node => node.TryGetAnswer(out ActuatorData answer) && answer.Shape >= 0 ? answer.Shape : double.NaN)
            {
                IsCategory = true, Categories = ShapeNames,
            },
        };

        /// <summary>
        /// Writes three values: the number of drones within a metre of their places on the shape; the number of shapes that drones now form; and the smallest
        /// distance in metres between the centres of two drones at the beginning of the tick, at most 2.5, and NaN before the first tick.
        /// </summary>
        public override void Measure(double[] values)
        {
            values[0] = 0;
            values[2] = Near;
            formed.Clear();
            foreach (var node in manager.Nodes)
            {
                if (node.TryGetAnswer(out ActuatorData answer) && answer.Shape >= 0)
                {
                    formed.Add(answer.Shape);
                    if (answer.Off <= InPlace) values[0]++;
                }
                manager.FindNodes(node.Position, (float)values[2], near, distances);
                for (var i = 0; i < near.Count; i++)
                {
                    if (near[i] != node && distances[i] < values[2]) values[2] = distances[i];
                }
            }
            values[1] = formed.Count;
            // Before the first tick, FindNodes finds no nodes.
            if (manager.Tick == 0) values[2] = double.NaN;
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            if (drones < 1 || !(shapeSeconds > 0) || !(speed > 0))
            {
                manager.Fail("the scene has " + drones + " drones that fly " + speed + " m/s and hold a shape for " + shapeSeconds
                    + " s: use at least one drone, and a time and a speed above 0");
                return;
            }
            this.manager = manager;
            // A sphere of this radius has room for all drones on its surface.
            var radius = Spacing * Mathf.Sqrt(drones / (4 * Mathf.PI));
            var side = Mathf.CeilToInt(Mathf.Sqrt(drones));
            var field = Mathf.Max(side * Pad, 3 * radius) + 4;
            MakeBox("Floor", new Vector3(0, -0.5f, 0), new Vector3(field, 1, field));
            // The masts are as high as the shapes, because cameras choose their view by the obstacles.
            foreach (var x in new[] { -1, 1 })
            {
                foreach (var z in new[] { -1, 1 })
                    MakeBox("Mast", new Vector3(x * field / 2, 1.4f * radius, z * field / 2), new Vector3(0.5f, 2.8f * radius, 0.5f));
            }
            for (var i = 0; i < drones; i++) MakeDrone(radius, new Vector3(i % side - (side - 1) / 2f, 0, i / side - (side - 1) / 2f) * Pad);
            if (droneModel != null) new GameObject("Drone View").AddComponent<DroneView>().Model = droneModel;
        }

        // Build does not add the handler, because Unity removes handlers when it compiles scripts during Play, and then calls only OnEnable.
        private void OnEnable()
        {
            manager = SimulationManager.Current;
            if (manager != null) manager.Ticked += FailWhenDue;
        }

        private void OnDisable()
        {
            if (manager != null) manager.Ticked -= FailWhenDue;
        }

        private void FailWhenDue(SimulationManager manager)
        {
            if (manager.SimulatedTime < failAfter) return;
            manager.Ticked -= FailWhenDue;
            near.Clear();
            foreach (var node in manager.Nodes)
            {
                if (node.TryGetAnswer(out ActuatorData answer) && answer.Leads) near.Add(node);
            }
            foreach (var leader in near) leader.gameObject.SetActive(false);
        }

        private void MakeDrone(float radius, Vector3 place)
        {
            var drone = new GameObject("Drone");
            drone.SetActive(false);
            // The drones have small random offsets. If all were in one plane, they would stay in it.
            var random = manager.Random;
            drone.transform.position = place + new Vector3(random.Range(-0.3f, 0.3f), random.Range(0.3f, 0.9f), random.Range(-0.3f, 0.3f));
            var parameters = drone.AddComponent<Node>().Parameters;
            parameters.Add(new NodeParameter("radius", radius.ToString(CultureInfo.InvariantCulture)));
            parameters.Add(new NodeParameter("shapeSeconds", shapeSeconds.ToString(CultureInfo.InvariantCulture)));
            parameters.Add(new NodeParameter("speed", speed.ToString(CultureInfo.InvariantCulture)));
            drone.AddComponent<RadiusNeighbourhood>().Radius = Near;
            drone.AddComponent<PositionSensor>();
            var fly = drone.AddComponent<FlyActuator>();
            fly.MaxSpeed = speed;
            fly.ReachTime = 1;
            drone.SetActive(true);
        }
    }
}
