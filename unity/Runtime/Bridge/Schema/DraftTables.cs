using System;

namespace Collektive.Bridge
{
    /// <summary>A vector of tables in a <see cref="Draft"/>. Its drafts are reused: do not keep them after <see cref="Clear"/>.</summary>
    public sealed class DraftTables<T> where T : Draft, new()
    {
        private T[] items = Array.Empty<T>();

        /// <summary>Number of elements. An empty list is absent from the frame unless the schema requires it.</summary>
        public int Count { get; private set; }

        /// <summary>The draft at an index below <see cref="Count"/>.</summary>
        public T this[int index]
        {
            get
            {
                if ((uint)index >= (uint)Count) throw new ArgumentOutOfRangeException(nameof(index));
                return items[index];
            }
        }

        /// <summary>Appends a draft with the defaults of the schema, and returns it so that the caller can fill it.</summary>
        public T Add()
        {
            if (Count == items.Length) Array.Resize(ref items, Math.Max(4, 2 * Count));
            var item = items[Count];
            if (item == null) items[Count] = item = new T();
            else item.Clear();
            Count++;
            return item;
        }

        /// <summary>Removes all elements.</summary>
        public void Clear()
        {
            Count = 0;
        }
    }
}
