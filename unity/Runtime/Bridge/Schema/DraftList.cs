using System;
using System.Runtime.CompilerServices;

namespace Collektive.Bridge
{
    /// <summary>A vector of scalars, structs or strings in a <see cref="Draft"/>. Its memory grows as needed and is never released.</summary>
    public sealed class DraftList<T>
    {
        private T[] items = Array.Empty<T>();

        /// <summary>Number of elements. An empty list is absent from the frame unless the schema requires it.</summary>
        public int Count { get; private set; }

        /// <summary>The element at an index below <see cref="Count"/>.</summary>
        public ref T this[int index]
        {
            get
            {
                if ((uint)index >= (uint)Count) throw new ArgumentOutOfRangeException(nameof(index));
                return ref items[index];
            }
        }

        /// <summary>The underlying array. Only its first <see cref="Count"/> elements belong to the list.</summary>
        internal T[] Items => items;

        /// <summary>Adds an element at the end.</summary>
        public void Add(T item)
        {
            if (Count == items.Length) Array.Resize(ref items, Math.Max(4, 2 * Count));
            items[Count++] = item;
        }

        /// <summary>Removes all elements.</summary>
        public void Clear()
        {
            if (RuntimeHelpers.IsReferenceOrContainsReferences<T>()) Array.Clear(items, 0, Count);
            Count = 0;
        }
    }
}
