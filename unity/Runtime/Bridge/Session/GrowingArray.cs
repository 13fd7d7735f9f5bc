using System;

namespace Collektive.Bridge
{
    /// <summary>A list that shows its array, so that it can be written as one block. Clearing keeps the memory.</summary>
    internal sealed class GrowingArray<T>
    {
        private T[] items = new T[16];

        /// <summary>The elements; only the first <see cref="Count"/> count.</summary>
        public T[] Items => items;

        /// <summary>How many elements there are.</summary>
        public int Count { get; private set; }

        /// <summary>Appends an element.</summary>
        public void Add(T item) => Add() = item;

        /// <summary>Appends an element that holds what was there before; valid until the next one is appended.</summary>
        public ref T Add()
        {
            if (Count == items.Length) Array.Resize(ref items, Count * 2);
            return ref items[Count++];
        }

        /// <summary>Makes it empty.</summary>
        public void Clear() => Truncate(0);

        /// <summary>Keeps the first <paramref name="count"/> elements, at most as many as there are.</summary>
        public void Truncate(int count)
        {
            Count = Math.Min(Count, count);
        }
    }
}
