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
        /// <summary>By node id: 1 + place among the wanted, 0 for all others. Scratch of one update; main thread only.</summary>
        private static int[] places = Array.Empty<int>();

        [SerializeField]
        [Tooltip("On: only the neighbours hear this node. Off: this node hears them too.")]
        private bool directed;

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres. A link's length is sent to the JVM when it is made, and again when it changed by more than this.")]
        private float lengthTolerance = 0.25f;

        private Neighbour[] wanted = Array.Empty<Neighbour>();
        private Neighbour[] held = Array.Empty<Neighbour>();
        private int wantedCount;
        private int heldCount;
        private int drops;
        private bool isAttached;

        private struct Neighbour
        {
            internal int Id;
            internal float Length;
            internal float Attenuation;
            internal LinkHandle Out;
            internal LinkHandle In;
            internal bool BothWays;
            internal bool IsHeld;
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

        internal sealed override void Attach(Node node)
        {
            node.Rules.Add(this);
            isAttached = true;
        }

        internal sealed override void Detach(Node node)
        {
            node.Rules.Remove(this);
            isAttached = false;
            if (SimulationManager.Current != null) ReleaseAll(SimulationManager.Current.Links);
        }

        internal void UpdateLinks(SimulationManager manager)
        {
            if (places.Length < manager.IdCapacity) Array.Resize(ref places, manager.IdCapacity);
            try
            {
                FindNeighbours(manager);
            }
            catch
            {
                // The links stay as they were.
                ForgetWanted();
                throw;
            }
            if (!isAttached || Node.Id < 0)
            {
                // The rule or its node left in the rule's own call, and the links with it.
                ForgetWanted();
                return;
            }
            var links = manager.Links;
            var dropped = links.Drops != drops;
            drops = links.Drops;
            var now = wanted;
            var before = held;
            for (var h = 0; h < heldCount; h++)
            {
                ref var old = ref before[h];
                var place = places[old.Id];
                if (place == 0) Release(links, old);
                // Most links of most ticks go this way: nothing to look up, nothing to send.
                else if (!dropped && IsSame(old, now[place - 1])) now[place - 1] = old;
                else if (!Keep(links, old, ref now[place - 1])) Release(links, old);
            }
            for (var w = 0; w < wantedCount; w++)
            {
                places[now[w].Id] = 0;
                if (!now[w].IsHeld) Hold(links, ref now[w]);
            }
            held = now;
            heldCount = wantedCount;
            wanted = before;
            wantedCount = 0;
        }

        private void ForgetWanted()
        {
            for (var w = 0; w < wantedCount; w++) places[wanted[w].Id] = 0;
            wantedCount = 0;
        }

        internal void ReleaseAll(LinkTable links)
        {
            for (var i = 0; i < heldCount; i++) Release(links, held[i]);
            heldCount = 0;
        }

        /// <summary>Names this node's neighbours by <see cref="Connect(Node)"/>. Called once before each tick; must not allocate.</summary>
        protected abstract void FindNeighbours(SimulationManager manager);

        /// <summary>Names a neighbour; the link gets the distance of the two nodes as its length, and no attenuation.</summary>
        protected void Connect(Node other)
        {
            Connect(other, Vector3.Distance(Node.Body.position, other.Body.position), 0);
        }

        /// <summary>
        /// Names a neighbour with the link's length in metres and attenuation (0 = clear). A node that takes no part in the simulation, the
        /// node itself, and a node named before are passed over.
        /// </summary>
        protected void Connect(Node other, float length, float attenuation)
        {
            Connect(other.Id, length, attenuation);
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
                neighbour.IsHeld = false;
                marks[id] = ++count;
            }
            wantedCount = count;
        }

        internal void Connect(int id, float length, float attenuation)
        {
            if (id < 0 || id == Node.Id || places[id] != 0) return;
            EnsureCapacity(wantedCount + 1);
            ref var neighbour = ref wanted[wantedCount];
            neighbour.Id = id;
            neighbour.Length = length;
            neighbour.Attenuation = attenuation;
            neighbour.IsHeld = false;
            places[id] = ++wantedCount;
        }

        private void EnsureCapacity(int count)
        {
            if (count > wanted.Length) Array.Resize(ref wanted, Math.Max(count, wanted.Length * 2));
        }

        private void Hold(LinkTable links, ref Neighbour neighbour)
        {
            neighbour.Out = links.Hold(Node.Id, neighbour.Id, neighbour.Length, neighbour.Attenuation);
            neighbour.BothWays = !directed;
            if (neighbour.BothWays) neighbour.In = links.Hold(neighbour.Id, Node.Id, neighbour.Length, neighbour.Attenuation);
            neighbour.IsHeld = true;
        }

        private bool IsSame(in Neighbour before, in Neighbour now) =>
            Math.Abs(before.Length - now.Length) <= lengthTolerance && before.Attenuation == now.Attenuation;

        /// <returns>False when the link is gone, because the other node left and came back.</returns>
        private bool Keep(LinkTable links, in Neighbour before, ref Neighbour now)
        {
            if (IsSame(before, now)) now.Length = before.Length;
            if (!links.Update(before.Out, now.Length, now.Attenuation)) return false;
            if (before.BothWays) links.Update(before.In, now.Length, now.Attenuation);
            now.Out = before.Out;
            now.In = before.In;
            now.BothWays = before.BothWays;
            now.IsHeld = true;
            return true;
        }

        private static void Release(LinkTable links, in Neighbour neighbour)
        {
            links.Release(neighbour.Out);
            if (neighbour.BothWays) links.Release(neighbour.In);
        }
    }
}
