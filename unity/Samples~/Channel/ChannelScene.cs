using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using channel;
using UnityEngine;

namespace CollektiveSamples.Channel
{
    /// <summary>
    /// Nodes on a plane of 100 x 60 m find a channel, the shortest path of links between two of them. Two walls across the direct path block radio, except in
    /// the gaps at their ends. After a while, the nodes in the gaps that the channel uses fail, and the channel takes another path.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Channel Scene")]
    public sealed class ChannelScene : SceneBuilder
    {
        private const int IgnoreRaycastLayer = 2;
        private const float WallPlace = 15;
        private const float WallLength = 40;

        private static readonly string[] Names = { "connected", "channel_nodes", "length" };
        private static readonly Vector3 SourcePlace = new Vector3(-45, 0.5f, -4);
        private static readonly Vector3 TargetPlace = new Vector3(45, 0.5f, -4);

        /// <summary>Number of nodes, including the two ends.</summary>
        [Min(2)]
        public int nodes = 600;

        /// <summary>Radio range of the nodes in metres.</summary>
        [Min(0)]
        public float range = 7;

        /// <summary>Simulated seconds after which the nodes in the channel's gaps fail.</summary>
        [Min(0)]
        public float failAfter = 10;

        private readonly List<LinkRecord> links = new List<LinkRecord>();
        private readonly HashSet<int> reached = new HashSet<int>();
        private readonly List<Node> failing = new List<Node>();
        private SimulationManager manager;
        private Node source;
        private Node target;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <inheritdoc/>
        public override IReadOnlyList<NodeColouring> Colourings => new[]
        {
            new NodeColouring("role", node => IsInChannel(node) ? 1 : 0) { IsCategory = true, Categories = new[] { "outside", "in the channel" } },
            new NodeColouring(
                "distance to the source",
                node => node.TryGetAnswer(out ActuatorData answer) && answer.Distance >= 0 ? answer.Distance : double.NaN)
            {
                Unit = "m",
            },
        };

        /// <inheritdoc/>
        public override IReadOnlyList<KeyValuePair<string, Vector3>> Landmarks => new[]
        {
            new KeyValuePair<string, Vector3>("source", SourcePlace), new KeyValuePair<string, Vector3>("target", TargetPlace),
        };

        /// <summary>
        /// Writes three values: 1 if the nodes of the channel connect source and target, otherwise 0; the number of nodes in the channel; and the length of the
        /// channel in metres, which the target has computed.
        /// </summary>
        public override void Measure(double[] values)
        {
            var count = 0;
            foreach (var node in manager.Nodes)
            {
                if (IsInChannel(node)) count++;
            }
            values[0] = IsConnected() ? 1 : 0;
            values[1] = count;
            values[2] = target.TryGetAnswer(out ActuatorData answer) ? answer.Distance : -1;
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            if (nodes < 2 || !(range >= 0))
            {
                manager.Fail("the scene has " + nodes + " nodes with a range of " + range + " m: use at least 2 nodes and a range of 0 or greater");
                return;
            }
            this.manager = manager;
            MakeBox("Floor", new Vector3(0, -0.5f, 0), new Vector3(104, 1, 64)).layer = IgnoreRaycastLayer;
            MakeBox("Wall", new Vector3(-WallPlace, 1.5f, 0), new Vector3(1, 3, WallLength));
            MakeBox("Wall", new Vector3(WallPlace, 1.5f, 0), new Vector3(1, 3, WallLength));
            source = MakeNode(SourcePlace, true, false);
            target = MakeNode(TargetPlace, false, true);
            for (var i = 2; i < nodes; i++) MakeNode(FreePlace(manager), false, false);
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
            failing.Clear();
            foreach (var node in manager.Nodes)
            {
                // The channel goes around the ends with negative z, because source and target are nearer to them.
                var place = node.transform.position;
                if (place.z < -WallLength / 2 && DistanceToWall(place) < range) failing.Add(node);
            }
            foreach (var node in failing) node.gameObject.SetActive(false);
        }

        private bool IsConnected()
        {
            reached.Clear();
            if (!IsInChannel(source) || !IsInChannel(target)) return false;
            reached.Add(source.Id);
            manager.CopyLinks(links);
            for (var before = 0; before < reached.Count;)
            {
                before = reached.Count;
                foreach (var link in links)
                {
                    if (reached.Contains(link.From) && IsInChannel(manager.Find(link.To))) reached.Add(link.To);
                }
            }
            return reached.Contains(target.Id);
        }

        private static bool IsInChannel(Node node) => node.TryGetAnswer(out ActuatorData answer) && answer.InChannel;

        private static float DistanceToWall(Vector3 place) => Mathf.Abs(Mathf.Abs(place.x) - WallPlace);

        /// <summary>Returns a random position outside the walls.</summary>
        private static Vector3 FreePlace(SimulationManager manager)
        {
            for (; ; )
            {
                var place = new Vector3(manager.Random.Range(-50f, 50f), 0.5f, manager.Random.Range(-30f, 30f));
                if (DistanceToWall(place) > 1 || Mathf.Abs(place.z) > WallLength / 2 + 0.5f) return place;
            }
        }

        private Node MakeNode(Vector3 place, bool isSource, bool isTarget)
        {
            var holder = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            holder.SetActive(false);
            holder.name = isSource ? "Source" : isTarget ? "Target" : "Node";
            // On this layer, the bodies of other nodes do not block radio.
            holder.layer = IgnoreRaycastLayer;
            holder.transform.position = place;
            if (isSource || isTarget) holder.transform.localScale = 2 * Vector3.one;
            var node = holder.AddComponent<Node>();
            holder.AddComponent<LineOfSightNeighbourhood>().Radius = range;
            holder.AddComponent<PositionSensor>();
            var end = holder.AddComponent<EndSensor>();
            end.Source = isSource;
            end.Target = isTarget;
            holder.AddComponent<ChannelColour>();
            holder.SetActive(true);
            return node;
        }
    }
}
