using System.Collections.Generic;

namespace Collektive.Unity
{
    /// <summary>
    /// Rules or sensors whose physics queries run in one batch, before the parts are called. A part adds itself at its first call, whose queries
    /// run alone; it is dropped when it or its node has left.
    /// </summary>
    internal sealed class BatchedParts
    {
        private readonly List<NodePart> parts = new List<NodePart>();
        private readonly Simulation simulation;

        internal BatchedParts(Simulation simulation) => this.simulation = simulation;

        internal int Count => parts.Count;

        internal NodePart this[int place] => parts[place];

        internal void Add(NodePart part)
        {
            if (ReferenceEquals(part.BatchedIn, this)) return;
            part.BatchedIn = this;
            parts.Add(part);
        }

        /// <summary>Drops parts that take no part in the simulation any more; the order of the rest changes.</summary>
        internal void DropGone()
        {
            for (var i = parts.Count - 1; i >= 0; i--)
            {
                var part = parts[i];
                if (part.IsAttached && ReferenceEquals(part.Node.Simulation, simulation)) continue;
                part.BatchedIn = null;
                parts[i] = parts[parts.Count - 1];
                parts.RemoveAt(parts.Count - 1);
            }
        }
    }
}
