using System;
using System.Threading;

namespace Collektive.Unity
{
    /// <summary>Results of one or several searches. While one thread appends, another may read the results that were published to it.</summary>
    internal sealed class NearNodes
    {
        private NearNode[] items = new NearNode[64];

        /// <summary>Only the first <see cref="Count"/> items are valid.</summary>
        internal NearNode[] Items => Volatile.Read(ref items);

        internal int Count { get; set; }

        /// <summary>Returns the items, with space for so many more.</summary>
        internal NearNode[] WithRoomFor(int more)
        {
            if (items.Length >= Count + more) return items;
            var larger = new NearNode[Math.Max(2 * items.Length, Count + more)];
            Array.Copy(items, larger, Count);
            Volatile.Write(ref items, larger);
            return larger;
        }

        /// <summary>Returns the items after the first <paramref name="start"/>.</summary>
        internal Span<NearNode> From(int start) => new Span<NearNode>(items, start, Count - start);
    }
}
