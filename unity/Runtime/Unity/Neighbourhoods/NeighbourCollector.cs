using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Collects the neighbours that a rule selects for a node, and finds near nodes for the rule. Use it only in <see
    /// cref="NeighbourhoodRule.FindNeighbours"/>. The node itself, nodes outside the simulation and nodes that were already added are ignored. Allocates
    /// only while its capacity grows.
    /// </summary>
    public sealed class NeighbourCollector
    {
        private readonly NodeGrid grid;
        private readonly GrowingArray<RuleNeighbour> all = new GrowingArray<RuleNeighbour>();
        // The node whose neighbours are collected; null outside a rule's call.
        private Node node;
        private int self;

        /// <param name="nodes">Participating nodes, ascending by id.</param>
        /// <param name="grid">The positions of the nodes in this tick.</param>
        internal NeighbourCollector(IReadOnlyList<Node> nodes, NodeGrid grid)
        {
            Nodes = nodes;
            this.grid = grid;
        }

        /// <summary>All participating nodes, ascending by id.</summary>
        public IReadOnlyList<Node> Nodes { get; }

        /// <summary>The nodes that the rule added. A node can occur several times.</summary>
        internal Span<RuleNeighbour> All => new Span<RuleNeighbour>(all.Items, 0, all.Count);

        /// <summary>The searches that ready-made rules requested in this tick.</summary>
        internal GrowingArray<RuleSearch> Searches { get; } = new GrowingArray<RuleSearch>();

        /// <summary>Adds a node. The link's length is the distance between the nodes, and its attenuation is 0.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public void Add(Node other)
        {
            CheckIsCollecting();
            // A node that was never active has no position.
            if (other.Id >= 0) Add(other.Id, Vector3.Distance(node.Position, other.Position), 0);
        }

        /// <summary>Adds a node, with the length of the link in metres and its attenuation (0: none).</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        /// <exception cref="ArgumentOutOfRangeException">Length or attenuation is negative, infinite or NaN.</exception>
        public void Add(Node other, float length, float attenuation)
        {
            CheckIsCollecting();
            if (!IsAmount(length)) throw new ArgumentOutOfRangeException(nameof(length), length, "a link's length must be finite and 0 or greater");
            CheckAttenuation(attenuation);
            Add(other.Id, length, attenuation);
        }

        /// <summary>Adds a node that a search found. The link's length is the distance that the search returned.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        /// <exception cref="ArgumentOutOfRangeException">The attenuation is negative, infinite or NaN.</exception>
        public void Add(in NearNode near, float attenuation = 0)
        {
            CheckIsCollecting();
            CheckAttenuation(attenuation);
            // Another rule may have removed the node after the grid was built.
            if (grid.NodeAt(near).Id == near.IdOfNode) Add(near.IdOfNode, near.Metres, attenuation);
        }

        /// <summary>Adds all nodes within <paramref name="radius"/> metres.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public void AddWithin(float radius)
        {
            var found = FindWithin(radius);
            for (var i = 0; i < found.Length; i++) Add(found[i]);
        }

        /// <summary>
        /// Returns the nodes within <paramref name="radius"/> metres, including the node itself, sorted by id. The result is valid until the next search.
        /// </summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public Span<NearNode> FindWithin(float radius)
        {
            CheckIsCollecting();
            return grid.Find(node.Position, radius);
        }

        /// <summary>
        /// Returns at most <paramref name="count"/> nearest nodes, including the node itself, sorted by distance and then by id. The result is valid until
        /// the next search. <paramref name="guess"/> is an estimate of the radius that contains the result, in metres; 0 for none. The search is fastest if
        /// the estimate is slightly too large.
        /// </summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public Span<NearNode> FindNearest(int count, float guess = 0)
        {
            CheckIsCollecting();
            return grid.FindNearest(node.Position, count, guess);
        }

        /// <summary>Returns the node that a search found.</summary>
        public Node NodeOf(in NearNode near) => grid.NodeAt(near);

        internal void Begin(Node collecting)
        {
            node = collecting;
            self = collecting.Id;
        }

        internal void End()
        {
            all.Clear();
            node = null;
        }

        internal void Add(int id, float length, float attenuation)
        {
            if (id < 0 || id == self) return;
            ref var neighbour = ref all.Add();
            neighbour.Id = id;
            neighbour.Length = length;
            neighbour.Attenuation = attenuation;
        }

        /// <summary>Requests a search for all nodes within a radius.</summary>
        internal void SearchWithin(float radius)
        {
            ref var search = ref Searches.Items[Searches.Count - 1];
            search.Nearest = RuleSearch.All;
            search.Outer = radius;
        }

        /// <summary>Requests a search for the nearest nodes.</summary>
        internal void SearchNearest(int count) => Searches.Items[Searches.Count - 1].Nearest = count;

        private static bool IsAmount(float value) => value >= 0 && !float.IsInfinity(value);

        private static void CheckAttenuation(float attenuation)
        {
            if (IsAmount(attenuation)) return;
            throw new ArgumentOutOfRangeException(nameof(attenuation), attenuation, "a link's attenuation must be finite and 0 or greater");
        }

        private void CheckIsCollecting()
        {
            if (node is null) throw new InvalidOperationException("neighbours can only be added in FindNeighbours");
        }
    }
}
