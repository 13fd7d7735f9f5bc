using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The positions of all nodes at this tick, which also become their <see cref="Node.Position"/>, for searches in C.</summary>
    internal sealed class NodeGrid
    {
        private readonly NeighbourSearch search;
        private Node[] nodes = Array.Empty<Node>();
        private NodePoint[] points = new NodePoint[64];

        internal NodeGrid(NeighbourSearch search) => this.search = search;

        /// <summary>
        /// Reads the positions of the first <paramref name="count"/> nodes, ascending by id; the array is kept. <paramref name="cell"/> is the side of the
        /// cells in metres, or 0 for the mean radius of the last searches.
        /// </summary>
        /// <exception cref="BridgeException">A position is not finite.</exception>
        internal void Build(Node[] all, int count, float cell = 0)
        {
            nodes = all;
            if (points.Length < count) points = new NodePoint[Math.Max(count, 2 * points.Length)];
            // Nodes are scattered in memory. In a short loop, the processor fetches more of them ahead.
            for (var i = 0; i < count; i++)
            {
                var node = all[i];
                var position = node.Body.position;
                node.Position = position;
                ref var point = ref points[i];
                point.X = position.x;
                point.Y = position.y;
                point.Z = position.z;
                point.Id = node.Id;
            }
            if (!search.TryPlace(new Span<NodePoint>(points, 0, count), cell)) FailNotFinite(count);
        }

        /// <summary>The nodes within <paramref name="radius"/> metres of a point, ascending by id; valid until the next search.</summary>
        internal Span<NearNode> Find(Vector3 centre, float radius) =>
            MemoryMarshal.Cast<NearPoint, NearNode>(search.Within(centre.x, centre.y, centre.z, radius));

        /// <summary>
        /// Returns at most <paramref name="limit"/> nodes nearest to a point, sorted by distance and then by id; valid until the next search. It is fastest
        /// if a radius of <paramref name="guess"/> metres contains a few more nodes than that; 0 for no guess.
        /// </summary>
        internal Span<NearNode> FindNearest(Vector3 centre, int limit, float guess) =>
            MemoryMarshal.Cast<NearPoint, NearNode>(search.Nearest(centre.x, centre.y, centre.z, limit, guess));

        /// <summary>Clears the lists and copies hits to them.</summary>
        internal void Copy(Span<NearNode> found, List<Node> to, List<float> distances)
        {
            to.Clear();
            distances.Clear();
            for (var i = 0; i < found.Length; i++)
            {
                to.Add(NodeAt(found[i]));
                distances.Add(found[i].Distance);
            }
        }

        /// <summary>The node of a hit.</summary>
        internal Node NodeAt(in NearNode hit) => nodes[hit.Place];

        private void FailNotFinite(int count)
        {
            for (var i = 0; i < count; i++)
            {
                // The difference of a number to itself is 0 only if it is finite.
                var position = nodes[i].Position;
                if ((position - position) == Vector3.zero) continue;
                throw new BridgeException(BridgeError.Argument, "the position of node " + nodes[i].Id + " ('" + nodes[i].name + "') is not finite, " + position
                    + ": fix the script that moves it");
            }
        }
    }
}
