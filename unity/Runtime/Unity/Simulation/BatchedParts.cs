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

        /// <summary>The number of the batch of this tick, 1 or greater.</summary>
        internal ulong Batch { get; private set; }

        /// <summary>Whether a part's queries are in the batch of this tick; if not, they are from the next tick on.</summary>
        internal bool Has(NodePart part)
        {
            if (ReferenceEquals(part.BatchedIn, this)) return part.BatchedAt == Batch;
            part.BatchedIn = this;
            part.BatchedAt = 0;
            parts.Add(part);
            return false;
        }

        /// <summary>Adds a part's queries to the batch.</summary>
        internal void Enqueue(NodePart part)
        {
            part.BatchedAt = Batch;
            part.Enqueue();
        }

        /// <summary>Begins a batch, and drops parts that take no part in the simulation any more; the order of the rest changes.</summary>
        internal void Begin()
        {
            Batch++;
            for (var i = parts.Count - 1; i >= 0; i--)
            {
                var part = parts[i];
                if (part.IsAttached && ReferenceEquals(part.Node.Simulation, simulation)) continue;
                if (ReferenceEquals(part.BatchedIn, this)) part.BatchedIn = null;
                parts[i] = parts[parts.Count - 1];
                parts.RemoveAt(parts.Count - 1);
            }
        }
    }
}
