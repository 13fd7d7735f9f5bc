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

        /// <summary>
        /// Begins a batch with the queries of all parts, or of those whose nodes are due in this tick. Drops parts that have left the simulation.
        /// </summary>
        internal void Begin(bool isForDueNodes)
        {
            Batch++;
            // One pass, because parts and nodes are scattered in memory.
            for (var i = parts.Count - 1; i >= 0; i--)
            {
                var part = parts[i];
                if (part.IsAttached && ReferenceEquals(part.Node.Simulation, simulation))
                {
                    if (isForDueNodes && !part.Node.IsDue) continue;
                    part.BatchedAt = Batch;
                    part.Enqueue(simulation.Context);
                    continue;
                }
                if (ReferenceEquals(part.BatchedIn, this)) part.BatchedIn = null;
                // The last part was already visited.
                parts[i] = parts[parts.Count - 1];
                parts.RemoveAt(parts.Count - 1);
            }
        }
    }
}
