using System;
using Collektive.Bridge;
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
        private static int[] places = new int[64];

        [SerializeField]
        [Tooltip("On: only the neighbours hear this node. Off: this node hears them too.")]
        private bool directed;

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres. A link's length is sent to the JVM when it is made, and again when it changed by more than this.")]
        private float lengthTolerance = 0.25f;

        private GrowingArray<Neighbour> wanted = new GrowingArray<Neighbour>();
        private GrowingArray<Neighbour> held = new GrowingArray<Neighbour>();

        private int drops;

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

        internal sealed override void Attach(Node node) => node.Rules.Add(this);

        internal sealed override void Detach(Node node)
        {
            node.Rules.Remove(this);
            if (SimulationManager.Current != null) ReleaseAll(SimulationManager.Current.Links);
        }

        internal void UpdateLinks(SimulationManager manager)
        {
            try
            {
                FindNeighbours(manager);
            }
            catch
            {
                // The links stay as they were.
                for (var w = 0; w < wanted.Count; w++) places[wanted.Items[w].Id] = 0;
                wanted.Clear();
                throw;
            }
            var links = manager.Links;
            var dropped = links.Drops != drops;
            drops = links.Drops;
            for (var h = 0; h < held.Count; h++)
            {
                ref var before = ref held.Items[h];
                var place = places[before.Id];
                if (place == 0 || !Keep(links, before, ref wanted.Items[place - 1], dropped)) Release(links, before);
            }
            for (var w = 0; w < wanted.Count; w++)
            {
                ref var neighbour = ref wanted.Items[w];
                places[neighbour.Id] = 0;
                if (!neighbour.IsHeld) Hold(links, ref neighbour);
            }
            held.Clear();
            var free = held;
            held = wanted;
            wanted = free;
        }

        internal void ReleaseAll(LinkTable links)
        {
            for (var i = 0; i < held.Count; i++) Release(links, held.Items[i]);
            held.Clear();
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

        internal void Connect(int id, float length, float attenuation)
        {
            if (id < 0 || id == Node.Id) return;
            if (id >= places.Length) Array.Resize(ref places, Math.Max(id + 1, places.Length * 2));
            if (places[id] != 0) return;
            ref var neighbour = ref wanted.Add();
            neighbour.Id = id;
            neighbour.Length = length;
            neighbour.Attenuation = attenuation;
            neighbour.IsHeld = false;
            places[id] = wanted.Count;
        }

        private void Hold(LinkTable links, ref Neighbour neighbour)
        {
            neighbour.Out = links.Hold(Node.Id, neighbour.Id, neighbour.Length, neighbour.Attenuation);
            neighbour.BothWays = !directed;
            if (neighbour.BothWays) neighbour.In = links.Hold(neighbour.Id, Node.Id, neighbour.Length, neighbour.Attenuation);
            neighbour.IsHeld = true;
        }

        /// <returns>False when the link is gone, because the other node left and came back.</returns>
        private bool Keep(LinkTable links, in Neighbour before, ref Neighbour now, bool dropped)
        {
            // Most links of most ticks go the short way: nothing to look up, nothing to send.
            var differs = Math.Abs(before.Length - now.Length) > lengthTolerance || before.Attenuation != now.Attenuation;
            if (!differs) now.Length = before.Length;
            if ((differs || dropped) && !links.Update(before.Out, now.Length, now.Attenuation)) return false;
            if ((differs || dropped) && before.BothWays) links.Update(before.In, now.Length, now.Attenuation);
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
