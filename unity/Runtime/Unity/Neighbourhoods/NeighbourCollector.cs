using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Collects the neighbours of a node from a rule, and finds near nodes. For use in <see cref="NeighbourhoodRule.FindNeighbours"/>
    /// only. The node itself, nodes outside the simulation and nodes added before are ignored.
    /// Allocates nothing once its capacity is reached.
    /// </summary>
    public sealed class NeighbourCollector
    {
        private readonly Simulation simulation;
        private Neighbour[] all = new Neighbour[64];
        // By node id: 1 + place in the list, 0 for those that are not in it.
        private readonly PagedArray<int> places = new PagedArray<int>();
        // Whose neighbours are collected; null outside of a rule's call.
        private Node node;
        private int self;

        internal NeighbourCollector(Simulation simulation) => this.simulation = simulation;

        internal struct Neighbour
        {
            internal int Id;
            internal float Length;
            internal float Attenuation;
        }

        /// <summary>All participating nodes, ascending by id.</summary>
        public IReadOnlyList<Node> Nodes => simulation.Nodes;

        internal int Count { get; private set; }

        internal Neighbour[] All => all;

        internal PagedArray<int> Places => places;

        /// <summary>Adds a node. The link's length is the distance of the nodes, and its attenuation 0.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public void Add(Node other)
        {
            CheckIsCollecting();
            // A node that was never active has no position.
            if (other.Id >= 0) Add(other.Id, Vector3.Distance(node.Position, other.Position), 0);
        }

        /// <summary>Adds a node with the link's length in metres and attenuation (0: none).</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        /// <exception cref="ArgumentOutOfRangeException">Length or attenuation is negative, infinite or NaN.</exception>
        public void Add(Node other, float length, float attenuation)
        {
            CheckIsCollecting();
            if (!IsAmount(length)) throw new ArgumentOutOfRangeException(nameof(length), length, "a link's length must be finite and 0 or greater");
            CheckAttenuation(attenuation);
            Add(other.Id, length, attenuation);
        }

        /// <summary>Adds a node that a search found; the link's length is its distance.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        /// <exception cref="ArgumentOutOfRangeException">The attenuation is negative, infinite or NaN.</exception>
        public void Add(in NearNode near, float attenuation = 0)
        {
            CheckIsCollecting();
            CheckAttenuation(attenuation);
            Add(near.IdOfNode, near.Metres, attenuation);
        }

        /// <summary>Adds all nodes within <paramref name="radius"/> metres.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public void AddWithin(float radius)
        {
            var found = FindWithin(radius);
            EnsureCapacity(Count + found.Length);
            // In a large scene this loop runs a million times a second.
            var own = self;
            var marks = places;
            var list = all;
            var count = Count;
            for (var i = 0; i < found.Length; i++)
            {
                ref var near = ref found[i];
                var id = near.IdOfNode;
                ref var mark = ref marks[id];
                if (id == own || mark != 0) continue;
                ref var neighbour = ref list[count];
                neighbour.Id = id;
                neighbour.Length = near.Metres;
                neighbour.Attenuation = 0;
                mark = ++count;
            }
            Count = count;
        }

        /// <summary>Returns the nodes within <paramref name="radius"/> metres, including the node itself, in no order. Valid until the next search.</summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public Span<NearNode> FindWithin(float radius)
        {
            CheckIsCollecting();
            return simulation.Grid.FindAround(node, radius);
        }

        /// <summary>
        /// Returns the nearest nodes, including the node itself, at most <paramref name="count"/>: the nearest first, at equal distances by id. Valid until
        /// the next search. It is fastest when <paramref name="guess"/> metres hold a few more than these; 0 for no guess.
        /// </summary>
        /// <exception cref="InvalidOperationException">Called outside of <see cref="NeighbourhoodRule.FindNeighbours"/>.</exception>
        public Span<NearNode> FindNearest(int count, float guess = 0)
        {
            CheckIsCollecting();
            var grid = simulation.Grid;
            return count < 1 ? default : grid.FindNearest(node.Position, count, guess > 0 ? guess : grid.MeanRadius);
        }

        /// <summary>The node that a search found.</summary>
        public Node NodeOf(in NearNode near) => simulation.Grid.NodeAt(near);

        internal void Begin(Node collecting)
        {
            node = collecting;
            self = collecting.Id;
        }

        internal void End()
        {
            for (var i = 0; i < Count; i++) places[all[i].Id] = 0;
            Count = 0;
            node = null;
        }

        internal void Add(int id, float length, float attenuation)
        {
            if (id < 0 || id == self) return;
            ref var mark = ref places[id];
            if (mark != 0) return;
            EnsureCapacity(Count + 1);
            all[Count] = new Neighbour { Id = id, Length = length, Attenuation = attenuation };
            mark = ++Count;
        }

        private static bool IsAmount(float value) => value >= 0 && !float.IsInfinity(value);

        private static void CheckAttenuation(float attenuation)
        {
            if (IsAmount(attenuation)) return;
            throw new ArgumentOutOfRangeException(nameof(attenuation), attenuation, "a link's attenuation must be finite and 0 or greater");
        }

        private void CheckIsCollecting()
        {
            if (node is null) throw new InvalidOperationException("neighbours can be added in FindNeighbours only");
        }

        private void EnsureCapacity(int count)
        {
            if (count > all.Length) Array.Resize(ref all, Math.Max(count, all.Length * 2));
        }
    }
}
