using System.Collections.Generic;
using System.Globalization;
using Collektive.Unity;
using leaderelection;
using UnityEngine;

namespace CollektiveSamples.LeaderElection
{
    /// <summary>
    /// Nodes at random positions on a plane of 100 x 60 m divide themselves into regions, each with a leader. After a while, all leaders fail, and other nodes
    /// replace them.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Leader Election Scene")]
    public sealed class LeaderElectionScene : SceneBuilder
    {
        private static readonly string[] Names = { "led", "regions", "farthest" };

        /// <summary>Number of nodes.</summary>
        [Min(1)]
        public int nodes = 400;

        /// <summary>Radio range of the nodes in metres.</summary>
        [Min(0)]
        public float range = 6;

        /// <summary>Maximum distance of a node from its leader in metres.</summary>
        [Min(0.1f)]
        public float radius = 20;

        /// <summary>Simulated seconds after which the leaders fail.</summary>
        [Min(0)]
        public float failAfter = 10;

        private readonly List<Node> leaders = new List<Node>();
        private SimulationManager manager;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <inheritdoc/>
        public override IReadOnlyList<NodeColouring> Colourings => new[]
        {
            new NodeColouring("leader", node => node.TryGetAnswer(out ActuatorData answer) ? answer.Leader : double.NaN) { IsCategory = true },
            new NodeColouring(
                "distance to the leader",
                node => node.TryGetAnswer(out ActuatorData answer) && answer.Distance >= 0 ? answer.Distance : double.NaN)
            {
                Unit = "m",
            },
        };

        /// <summary>
        /// Writes the number of nodes with a valid leader, the number of their leaders, and the greatest distance between a node and its leader in metres.
        /// </summary>
        public override void Measure(double[] values)
        {
            leaders.Clear();
            var led = 0;
            var farthest = 0f;
            foreach (var node in manager.Nodes)
            {
                var leader = LeaderOf(node);
                if (leader == null || LeaderOf(leader) != leader) continue;
                var distance = Vector3.Distance(leader.transform.position, node.transform.position);
                if (distance > radius) continue;
                if (distance > farthest) farthest = distance;
                if (!leaders.Contains(leader)) leaders.Add(leader);
                led++;
            }
            values[0] = led;
            values[1] = leaders.Count;
            values[2] = farthest;
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            if (nodes < 1 || !(range >= 0) || !(radius > 0))
            {
                manager.Fail("the scene has " + nodes + " nodes with a range of " + range + " m and regions of " + radius
                    + " m: use at least one node, a region radius above 0, and a range of 0 or greater");
                return;
            }
            this.manager = manager;
            MakeBox("Floor", new Vector3(0, -0.5f, 0), new Vector3(104, 1, 64));
            for (var i = 0; i < nodes; i++) MakeNode(new Vector3(manager.Random.Range(-50f, 50f), 0.5f, manager.Random.Range(-30f, 30f)));
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
            leaders.Clear();
            foreach (var node in manager.Nodes)
            {
                if (LeaderOf(node) == node) leaders.Add(node);
            }
            foreach (var leader in leaders) leader.gameObject.SetActive(false);
        }

        private Node LeaderOf(Node node) => node.TryGetAnswer(out ActuatorData answer) ? manager.Find(answer.Leader) : null;

        private void MakeNode(Vector3 place)
        {
            var holder = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            holder.SetActive(false);
            holder.name = "Node";
            holder.transform.position = place;
            var node = holder.AddComponent<Node>();
            node.Parameters.Add(new NodeParameter("radius", radius.ToString(CultureInfo.InvariantCulture)));
            holder.AddComponent<RadiusNeighbourhood>().Radius = range;
            holder.AddComponent<PositionSensor>();
            holder.AddComponent<LeaderColour>();
            var lamp = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            lamp.name = "Lamp";
            lamp.transform.SetParent(holder.transform, false);
            lamp.transform.localPosition = 1.5f * Vector3.up;
            holder.AddComponent<LeaderLamp>().Target = lamp.GetComponent<Renderer>();
            holder.SetActive(true);
        }
    }
}
