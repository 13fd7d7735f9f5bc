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
        /// <summary>Links whose length changed by less than this many metres are not sent again.</summary>
        private const float LengthTolerance = 0.05f;

        [SerializeField]
        [Tooltip("On: only the neighbours hear this node. Off: this node hears them too.")]
        private bool directed;

        private GrowingArray<Neighbour> wanted = new GrowingArray<Neighbour>();
        private GrowingArray<Neighbour> held = new GrowingArray<Neighbour>();

        private struct Neighbour
        {
            internal int Id;
            internal float Length;
            internal float Attenuation;
            internal LinkHandle Out;
            internal LinkHandle In;
            internal bool BothWays;
        }

        /// <summary>Whether only the neighbours hear this node. Takes effect for links made from now on.</summary>
        public bool Directed
        {
            get => directed;
            set => directed = value;
        }

        internal sealed override void Attach(Node node) => node.Rules.Add(this);

        internal sealed override void Detach(Node node)
        {
            node.Rules.Remove(this);
            if (SimulationManager.Current != null) ReleaseAll(SimulationManager.Current.Links);
        }

        internal void UpdateLinks(SimulationManager manager)
        {
            FindNeighbours(manager);
            Sort(wanted);
            var links = manager.Links;
            var w = 0;
            var h = 0;
            while (w < wanted.Count || h < held.Count)
            {
                if (h == held.Count || w < wanted.Count && wanted.Items[w].Id < held.Items[h].Id)
                {
                    Hold(links, ref wanted.Items[w++]);
                }
                else if (w == wanted.Count || held.Items[h].Id < wanted.Items[w].Id)
                {
                    Release(links, held.Items[h++]);
                }
                else
                {
                    Keep(links, held.Items[h++], ref wanted.Items[w++]);
                }
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
        /// Names a neighbour, at most once a tick, with the link's length in metres and attenuation (0 = clear). A node that takes
        /// no part in the simulation, and the node itself, are passed over.
        /// </summary>
        protected void Connect(Node other, float length, float attenuation)
        {
            if (other.Id < 0 || ReferenceEquals(other, Node)) return;
            wanted.Add(new Neighbour { Id = other.Id, Length = length, Attenuation = attenuation });
        }

        private void Hold(LinkTable links, ref Neighbour neighbour)
        {
            neighbour.Out = links.Hold(Node.Id, neighbour.Id, neighbour.Length, neighbour.Attenuation);
            neighbour.BothWays = !directed;
            if (neighbour.BothWays) neighbour.In = links.Hold(neighbour.Id, Node.Id, neighbour.Length, neighbour.Attenuation);
        }

        private void Keep(LinkTable links, in Neighbour before, ref Neighbour now)
        {
            if (!links.Update(before.Out, now.Length, now.Attenuation, LengthTolerance))
            {
                Hold(links, ref now);
                return;
            }
            now.Out = before.Out;
            now.In = before.In;
            now.BothWays = before.BothWays;
            if (now.BothWays) links.Update(now.In, now.Length, now.Attenuation, LengthTolerance);
        }

        private static void Release(LinkTable links, in Neighbour neighbour)
        {
            links.Release(neighbour.Out);
            if (neighbour.BothWays) links.Release(neighbour.In);
        }

        /// <summary>Neighbours come nearly in order from tick to tick, and are few: insertion sort.</summary>
        private static void Sort(GrowingArray<Neighbour> neighbours)
        {
            var items = neighbours.Items;
            for (var i = 1; i < neighbours.Count; i++)
            {
                var item = items[i];
                var place = i;
                for (; place > 0 && items[place - 1].Id > item.Id; place--) items[place] = items[place - 1];
                items[place] = item;
            }
        }
    }
}
