using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using UnityEngine;

namespace Gradients
{
    /// <summary>
    /// Nodes on a grid that is a little out of order, linked within a range. The source is the node in one corner, and after a while the one in the
    /// opposite corner.
    /// </summary>
    public sealed class GradientScene : SceneBuilder
    {
        /// <summary>A distance that is not known, or greater, counts as this one.</summary>
        private const double Farthest = 100;

        private static readonly string[] Names = { "error", "reached" };

        /// <summary>How many nodes a side of the grid has.</summary>
        public int columns = 7;

        /// <summary>Metres from one node to the next.</summary>
        public float spacing = 6;

        /// <summary>Metres by which a node may be off its place, along each axis.</summary>
        public float positionNoise = 1.5f;

        /// <summary>Range of radios in metres.</summary>
        public float range = 10;

        /// <summary>Simulated seconds after which the source is the other one.</summary>
        public float switchAfter = 3;

        private readonly List<LinkRecord> links = new List<LinkRecord>();
        private SimulationManager manager;
        private SourceSensor first;
        private SourceSensor second;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <summary>Mean absolute error of the distances in metres, and the part of the nodes that has a distance.</summary>
        public override void Measure(double[] values)
        {
            var right = Distances();
            var reached = 0;
            values[0] = 0;
            foreach (var node in manager.Nodes)
            {
                var distance = node.TryGetAnswer(out gradients.ActuatorData answer) && answer.Distance >= 0 ? answer.Distance : Farthest;
                if (distance < Farthest) reached++;
                values[0] += System.Math.Abs(System.Math.Min(distance, Farthest) - right[node.Id]) / manager.Nodes.Count;
            }
            values[1] = reached / (double)manager.Nodes.Count;
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            this.manager = manager;
            // The programs know the sources by these ids.
            first = MakeNode(0);
            second = MakeNode(columns * columns - 1);
            first.Source = true;
            for (var place = 1; place < columns * columns - 1; place++) MakeNode(place);
            manager.Ticked += SwitchWhenDue;
        }

        private void SwitchWhenDue(SimulationManager manager)
        {
            if (manager.SimulatedTime < switchAfter) return;
            first.Source = false;
            second.Source = true;
        }

        private SourceSensor MakeNode(int place)
        {
            var holder = new GameObject("Node");
            holder.transform.position = spacing * new Vector3(place % columns, 0, place / columns)
                + new Vector3(manager.Random.Range(-positionNoise, positionNoise), 0, manager.Random.Range(-positionNoise, positionNoise));
            holder.AddComponent<Node>();
            holder.AddComponent<RadiusNeighbourhood>().Radius = range;
            holder.AddComponent<PositionSensor>();
            return holder.AddComponent<SourceSensor>();
        }

        /// <summary>By id: the length of the shortest way along links to the source (Bellman and Ford's algorithm, on the whole graph).</summary>
        private double[] Distances()
        {
            var distances = new double[manager.Nodes.Count];
            for (var i = 0; i < distances.Length; i++) distances[i] = Farthest;
            distances[first.Source ? 0 : 1] = 0;
            manager.CopyLinks(links);
            for (var changed = true; changed;)
            {
                changed = false;
                foreach (var link in links)
                {
                    if (distances[link.From] + link.Length >= distances[link.To]) continue;
                    distances[link.To] = distances[link.From] + link.Length;
                    changed = true;
                }
            }
            return distances;
        }
    }

    /// <summary>Measures the node's position.</summary>
    public sealed class PositionSensor : PositionSensor<gradients.SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref gradients.SensorData data, Vector3 position) => data.Position = position.ToValue();
    }

    /// <summary>Writes whether the node is the source.</summary>
    public sealed class SourceSensor : Sensor<gradients.SensorData>
    {
        /// <summary>Whether it is.</summary>
        public bool Source { get; set; }

        /// <inheritdoc/>
        protected override void Sense(ref gradients.SensorData data) => data.Source = Source;
    }
}
