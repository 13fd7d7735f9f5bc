using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The positions of all nodes in this tick, for searches in C. Building the grid also sets the nodes' <see cref="Node.Position"/>.</summary>
    internal sealed class NodeGrid
    {
        private readonly NeighbourSearch search;
        private Node[] nodes = Array.Empty<Node>();
        private NodePoint[] points = new NodePoint[64];

        internal NodeGrid(NeighbourSearch search) => this.search = search;

        /// <summary>
        /// Reads the positions of the first <paramref name="count"/> nodes of an array that is sorted by id. The grid keeps a reference to the array.
        /// <paramref name="cell"/> is the side length of the cells in metres; 0 selects the mean radius of the last searches.
        /// </summary>
        /// <exception cref="BridgeException">A position is not finite.</exception>
        internal void Build(Node[] all, int count, float cell = 0)
        {
            nodes = all;
            if (points.Length < count) points = new NodePoint[Math.Max(count, 2 * points.Length)];
            // Nodes are scattered in memory. The shorter the loop, the more nodes the processor can prefetch.
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

        /// <summary>Returns the nodes within <paramref name="radius"/> metres of a point, sorted by id. The result is valid until the next search.</summary>
        internal Span<NearNode> Find(Vector3 centre, float radius) =>
            MemoryMarshal.Cast<NearPoint, NearNode>(search.Within(centre.x, centre.y, centre.z, radius));

        /// <summary>
        /// Returns at most <paramref name="limit"/> nodes nearest to a point, sorted by distance and then by id. The result is valid until the next search.
        /// <paramref name="guess"/> is an estimate of the radius that contains the result, in metres; 0 for none. The search is fastest if the estimate is
        /// slightly too large.
        /// </summary>
        internal Span<NearNode> FindNearest(Vector3 centre, int limit, float guess) =>
            MemoryMarshal.Cast<NearPoint, NearNode>(search.Nearest(centre.x, centre.y, centre.z, limit, guess));

        /// <summary>Replaces the content of the lists with the found nodes and their distances. Skips nodes that left after the grid was built.</summary>
        internal void Copy(Span<NearNode> found, List<Node> to, List<float> distances)
        {
            to.Clear();
            distances.Clear();
            for (var i = 0; i < found.Length; i++)
            {
                if (NodeAt(found[i]).Id != found[i].Id) continue;
                to.Add(NodeAt(found[i]));
                distances.Add(found[i].Distance);
            }
        }

        /// <summary>Returns the node of a search hit.</summary>
        internal Node NodeAt(in NearNode hit) => nodes[hit.Place];

        private void FailNotFinite(int count)
        {
            for (var i = 0; i < count; i++)
            {
                // A number minus itself is 0 only if the number is finite.
                var position = nodes[i].Position;
                if ((position - position) == Vector3.zero) continue;
                throw new BridgeException(BridgeError.Argument, "the position of node " + nodes[i].Id + " ('" + nodes[i].name + "') is not finite, " + position
                    + ": fix the script that moves it");
            }
        }
    }
}
