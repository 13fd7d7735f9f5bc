using System.Collections.Generic;

namespace Collektive.Unity
{
    /// <summary>
    /// Rules or sensors whose physics queries run in one batch before the parts are called. A part joins when it is first called; the queries of that call
    /// run without the batch. A part is removed when it or its node has left the simulation.
    /// </summary>
    internal sealed class BatchedParts
    {
        private readonly List<NodePart> parts = new List<NodePart>();
        private readonly Simulation simulation;

        internal BatchedParts(Simulation simulation) => this.simulation = simulation;

        /// <summary>The number of this tick's batch, 1 or greater.</summary>
        internal ulong Batch { get; private set; }

        /// <summary>
        /// Returns whether this tick's batch contains the queries of a part. If not, the part is added, and the batches from the next tick on contain them.
        /// </summary>
        internal bool Has(NodePart part)
        {
            if (ReferenceEquals(part.BatchedIn, this)) return part.BatchedAt == Batch;
            part.BatchedIn = this;
            part.BatchedAt = 0;
            parts.Add(part);
            return false;
        }

        /// <summary>
        /// Begins a batch with the queries of all parts, or only of parts whose nodes are due in this tick. Removes parts that have left the simulation.
        /// </summary>
        internal void Begin(bool isForDueNodes)
        {
            Batch++;
            // A single pass does both, because parts and nodes are scattered in memory.
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
                // The last part moves to this index. It was already visited.
                parts[i] = parts[parts.Count - 1];
                parts.RemoveAt(parts.Count - 1);
            }
        }
    }
}
