using System;

namespace Collektive.Unity
{
    /// <summary>
    /// A node's parts of one kind, in the order in which they were enabled. A field of the node rather than an object of its own: in a large
    /// scene a tick spends more on fetching objects from memory than on what it does with them.
    /// </summary>
    internal struct PartList<T>
        where T : NodePart
    {
        private T[] parts;

        internal int Count { get; private set; }

        internal T this[int place] => parts[place];

        internal void Add(T part)
        {
            if (parts == null || Count == parts.Length) Array.Resize(ref parts, Math.Max(2, 2 * Count));
            parts[Count++] = part;
        }

        /// <summary>Those behind it move up. Nothing happens when it is not there.</summary>
        internal void Remove(T part)
        {
            var place = Count - 1;
            while (place >= 0 && !ReferenceEquals(parts[place], part)) place--;
            if (place < 0) return;
            Count--;
            Array.Copy(parts, place + 1, parts, place, Count - place);
            parts[Count] = null;
        }

        /// <summary>Whether a part is where it was before its call: it may have been disabled or destroyed, or have come back at the end.</summary>
        internal bool Has(int place, T part) => place < Count && ReferenceEquals(parts[place], part);
    }
}
