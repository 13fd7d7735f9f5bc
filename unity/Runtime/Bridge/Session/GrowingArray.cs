using System;

namespace Collektive.Bridge
{
    /// <summary>A list whose underlying array is accessible, so that it can be written as one block. Clearing keeps the memory.</summary>
    internal sealed class GrowingArray<T>
    {
        private T[] items = new T[16];

        /// <summary>The elements; only the first <see cref="Count"/> are valid.</summary>
        public T[] Items => items;

        /// <summary>Number of elements.</summary>
        public int Count { get; private set; }

        /// <summary>Appends an element.</summary>
        public void Add(T item) => Add() = item;

        /// <summary>Appends an element without initialising it, and returns a reference that is valid until the next element is appended.</summary>
        public ref T Add()
        {
            if (Count == items.Length) Array.Resize(ref items, Count * 2);
            return ref items[Count++];
        }

        /// <summary>Appends a block of elements.</summary>
        public void AddAll(ReadOnlySpan<T> block)
        {
            var count = Count + block.Length;
            if (count > items.Length) Array.Resize(ref items, Math.Max(count, items.Length * 2));
            block.CopyTo(new Span<T>(items, Count, block.Length));
            Count = count;
        }

        /// <summary>Removes all elements.</summary>
        public void Clear() => Truncate(0);

        /// <summary>Keeps at most the first <paramref name="count"/> elements.</summary>
        public void Truncate(int count)
        {
            Count = Math.Min(Count, count);
        }
    }
}
