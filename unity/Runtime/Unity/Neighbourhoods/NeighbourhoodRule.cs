using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Decides which nodes receive a node's messages. Before each tick <see cref="FindNeighbours"/> collects the neighbours; the rule adds
    /// and removes the links. A node may have several rules: a link exists while one of them, or a script, references it.
    /// </summary>
    public abstract class NeighbourhoodRule : NodePart
    {
        [SerializeField]
        [Tooltip("On: neighbours receive messages from this node. Off: it also receives theirs.")]
        private bool directed;

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres. A link's length is sent to the JVM again after it changed by more than this.")]
        private float lengthTolerance = 0.25f;

        // Parallel arrays: `held` is read in each tick, `links` only when a link changes.
        private NeighbourCollector.Neighbour[] held = Array.Empty<NeighbourCollector.Neighbour>();
        private LinkHandle[] links = Array.Empty<LinkHandle>();
        private int heldCount;
        private int removalCount;
        // Users' code may do anything with physics.
        private bool isOwn;

        /// <summary>Whether neighbours receive messages from this node without sending to it. Takes effect for new links.</summary>
        public bool Directed
        {
            get => directed;
            set => directed = value;
        }

        /// <summary>
        /// Metres, 0 or greater. A link's length is sent to the JVM when it is made, and again when it changed by more than this: in a
        /// swarm all lengths change a little in each tick, and sending them can cost as much as the rounds.
        /// </summary>
        public float LengthTolerance
        {
            get => lengthTolerance;
            set => lengthTolerance = value;
        }

        internal sealed override ref PartList ListOf(Node node)
        {
            isOwn = GetType().Assembly == typeof(NeighbourhoodRule).Assembly;
            return ref node.Rules;
        }

        internal sealed override void Detached()
        {
            if (Node.Simulation != null) ReleaseAll(Node.Simulation.Links);
        }

        /// <summary>Updates the links of this rule.</summary>
        internal sealed override void Run(Simulation simulation, int index)
        {
            var neighbours = simulation.Neighbours;
            if (!isOwn) simulation.Queries.Finish();
            neighbours.Begin(Node);
            try
            {
                FindNeighbours(neighbours);
                // Not when the rule or its node left in the rule's own call, and the links with it.
                if (IsAttached && Node.Id >= 0) Take(neighbours, simulation.Links);
            }
            finally
            {
                // After an exception the links stay as they were.
                neighbours.End();
            }
        }

        internal void ReleaseAll(LinkTable table)
        {
            for (var i = 0; i < heldCount; i++) table.Release(links[i]);
            heldCount = 0;
        }

        /// <summary>Adds this node's current neighbours to <paramref name="neighbours"/>. Called once before each tick; must not allocate.</summary>
        protected abstract void FindNeighbours(NeighbourCollector neighbours);

        private void Take(NeighbourCollector neighbours, LinkTable table)
        {
            var dropped = table.RemovalCount != removalCount;
            removalCount = table.RemovalCount;
            var marks = neighbours.Places;
            var all = neighbours.All;
            var kept = held;
            var tolerance = lengthTolerance;
            var left = heldCount;
            for (var h = 0; h < left;)
            {
                ref var old = ref kept[h];
                ref var mark = ref marks[old.Id];
                var place = mark - 1;
                if (place < 0)
                {
                    table.Release(links[h]);
                    old = kept[--left];
                    links[h] = links[left];
                    continue;
                }
                mark = 0;
                ref var now = ref all[place];
                var change = now.Length - old.Length;
                // The usual case: nothing to look up, nothing to send.
                if (dropped || change > tolerance || -change > tolerance || now.Attenuation != old.Attenuation) Change(table, h, now, dropped);
                h++;
            }
            heldCount = left;
            for (var w = 0; w < neighbours.Count; w++)
            {
                ref var mark = ref marks[all[w].Id];
                if (mark == 0) continue;
                mark = 0;
                if (heldCount == held.Length)
                {
                    Array.Resize(ref held, Math.Max(16, 2 * heldCount));
                    Array.Resize(ref links, held.Length);
                }
                AddLink(table, heldCount++, all[w]);
            }
        }

        private void AddLink(LinkTable table, int place, in NeighbourCollector.Neighbour now)
        {
            held[place] = now;
            links[place] = table.AddReference(Node.Id, now.Id, !directed, now.Length, now.Attenuation);
        }

        private void Change(LinkTable table, int place, in NeighbourCollector.Neighbour now, bool dropped)
        {
            // The link is gone when the other node left and came back.
            if (dropped && !table.IsAlive(links[place]))
            {
                AddLink(table, place, now);
                return;
            }
            ref var old = ref held[place];
            var length = Math.Abs(now.Length - old.Length) > lengthTolerance ? now.Length : old.Length;
            if (length == old.Length && now.Attenuation == old.Attenuation) return;
            old.Length = length;
            old.Attenuation = now.Attenuation;
            table.Update(links[place], length, now.Attenuation);
        }
    }
}
