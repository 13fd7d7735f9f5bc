using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Decides who hears a node. Before each tick <see cref="FindNeighbours"/> names the neighbours of that moment; the rule makes and
    /// removes the links. Several rules may stand on one node: a link exists while one of them, or a script, wants it.
    /// </summary>
    public abstract class NeighbourhoodRule : NodePart
    {
        // Scratch of one update, of the rule that is asked; a rule at a time, on the main thread. By node id: 1 + place among the wanted, 0 for all others.
        private static int[] places = Array.Empty<int>();
        private static Neighbour[] wanted = new Neighbour[64];
        private static int wantedCount;
        private static NeighbourhoodRule asked;

        [SerializeField]
        [Tooltip("On: only the neighbours hear this node. Off: this node hears them too.")]
        private bool directed;

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres. A link's length is sent to the JVM when it is made, and again when it changed by more than this.")]
        private float lengthTolerance = 0.25f;

        // What is looked at in each tick, and place for place what is needed when a link changes.
        private Neighbour[] held = Array.Empty<Neighbour>();
        private LinkHandle[] links = Array.Empty<LinkHandle>();
        private int heldCount;
        private int drops;

        private struct Neighbour
        {
            internal int Id;
            internal float Length;
            internal float Attenuation;
        }

        /// <summary>Whether only the neighbours hear this node. Takes effect for links made from now on.</summary>
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

        internal sealed override ref PartList ListOf(Node node) => ref node.Rules;

        internal sealed override void Detached()
        {
            if (Node.Simulation != null) ReleaseAll(Node.Simulation.Links);
        }

        /// <summary>Brings the links of this rule up to date.</summary>
        internal sealed override void Run(Simulation simulation, int index)
        {
            if (places.Length < simulation.IdCapacity) Array.Resize(ref places, simulation.IdCapacity);
            asked = this;
            try
            {
                FindNeighbours(simulation.Manager);
                // Not when the rule or its node left in the rule's own call, and the links with it.
                if (IsAttached && Node.Id >= 0) TakeWanted(simulation.Links);
            }
            finally
            {
                // After an exception the links stay as they were.
                for (var w = 0; w < wantedCount; w++) places[wanted[w].Id] = 0;
                wantedCount = 0;
                asked = null;
            }
        }

        internal void ReleaseAll(LinkTable table)
        {
            for (var i = 0; i < heldCount; i++) table.Release(links[i]);
            heldCount = 0;
        }

        /// <summary>Names this node's neighbours by <see cref="Connect(Node)"/>. Called once before each tick; must not allocate.</summary>
        protected abstract void FindNeighbours(SimulationManager manager);

        /// <summary>
        /// Names a neighbour; the link gets the distance of the two nodes as its length, and no attenuation. A node that takes no part in the
        /// simulation, the node itself, and a node named before are passed over.
        /// </summary>
        /// <exception cref="InvalidOperationException">It was not called from <see cref="FindNeighbours"/>.</exception>
        protected void Connect(Node other)
        {
            // One that never was active has no place yet.
            if (other.Id >= 0) Connect(other, Vector3.Distance(Node.Position, other.Position), 0);
        }

        /// <summary>
        /// Names a neighbour with the link's length in metres and attenuation (0 = clear). A node that takes no part in the simulation, the
        /// node itself, and a node named before are passed over.
        /// </summary>
        /// <exception cref="InvalidOperationException">It was not called from <see cref="FindNeighbours"/>.</exception>
        /// <exception cref="ArgumentOutOfRangeException">Length or attenuation is negative, infinite or no number.</exception>
        protected void Connect(Node other, float length, float attenuation)
        {
            if (!ReferenceEquals(asked, this)) throw new InvalidOperationException("neighbours can be named in FindNeighbours only");
            if (!IsAmount(length)) throw new ArgumentOutOfRangeException(nameof(length), length, "a link's length is 0 or greater, and finite");
            if (!IsAmount(attenuation))
                throw new ArgumentOutOfRangeException(nameof(attenuation), attenuation, "a link's attenuation is 0 or greater, and finite");
            // Nodes may have joined since the update began.
            if (other.Id >= places.Length) Array.Resize(ref places, other.Simulation.IdCapacity);
            Connect(other.Id, length, attenuation);
        }

        internal void Connect(int id, float length, float attenuation)
        {
            if (id < 0 || id == Node.Id || places[id] != 0) return;
            EnsureCapacity(wantedCount + 1);
            ref var neighbour = ref wanted[wantedCount];
            neighbour.Id = id;
            neighbour.Length = length;
            neighbour.Attenuation = attenuation;
            places[id] = ++wantedCount;
        }

        /// <summary>Names all nodes that a search found, without attenuation.</summary>
        internal void Connect(Span<NodeGrid.Hit> hits)
        {
            EnsureCapacity(wantedCount + hits.Length);
            // A large scene comes by here a million times a second.
            var self = Node.Id;
            var marks = places;
            var all = wanted;
            var count = wantedCount;
            for (var i = 0; i < hits.Length; i++)
            {
                ref var hit = ref hits[i];
                var id = hit.Id;
                if (id == self || marks[id] != 0) continue;
                ref var neighbour = ref all[count];
                neighbour.Id = id;
                neighbour.Length = hit.Distance;
                neighbour.Attenuation = 0;
                marks[id] = ++count;
            }
            wantedCount = count;
        }

        private static bool IsAmount(float value) => value >= 0 && !float.IsInfinity(value);

        private static void EnsureCapacity(int count)
        {
            if (count > wanted.Length) Array.Resize(ref wanted, Math.Max(count, wanted.Length * 2));
        }

        private void TakeWanted(LinkTable table)
        {
            var dropped = table.Drops != drops;
            drops = table.Drops;
            var marks = places;
            var all = wanted;
            var kept = held;
            var tolerance = lengthTolerance;
            var left = heldCount;
            for (var h = 0; h < left;)
            {
                ref var old = ref kept[h];
                var place = marks[old.Id] - 1;
                if (place < 0)
                {
                    table.Release(links[h]);
                    old = kept[--left];
                    links[h] = links[left];
                    continue;
                }
                marks[old.Id] = 0;
                ref var now = ref all[place];
                var change = now.Length - old.Length;
                // Most links of most ticks go this way: nothing to look up, nothing to send.
                if (dropped || change > tolerance || -change > tolerance || now.Attenuation != old.Attenuation) Change(table, h, now, dropped);
                h++;
            }
            heldCount = left;
            for (var w = 0; w < wantedCount; w++)
            {
                ref var mark = ref marks[all[w].Id];
                if (mark == 0) continue;
                mark = 0;
                if (heldCount == held.Length)
                {
                    Array.Resize(ref held, Math.Max(16, 2 * heldCount));
                    Array.Resize(ref links, held.Length);
                }
                Hold(table, heldCount++, all[w]);
            }
            wantedCount = 0;
        }

        private void Hold(LinkTable table, int place, in Neighbour now)
        {
            held[place] = now;
            links[place] = table.Hold(Node.Id, now.Id, !directed, now.Length, now.Attenuation);
        }

        private void Change(LinkTable table, int place, in Neighbour now, bool dropped)
        {
            // The link is gone when the other node left and came back.
            if (dropped && !table.IsAlive(links[place]))
            {
                Hold(table, place, now);
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
