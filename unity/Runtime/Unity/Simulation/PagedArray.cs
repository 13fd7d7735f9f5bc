using System;

namespace Collektive.Unity
{
    /// <summary>
    /// An array that grows in pages, which are allocated on first use. A large index therefore does not allocate memory for all smaller indices.
    /// </summary>
    internal sealed class PagedArray<T>
    {
        private const int Bits = 7;
        private const int Mask = (1 << Bits) - 1;

        private T[][] pages = new T[4][];

        /// <summary>The value at an index of 0 or greater, initially the default of its type. The reference remains valid when the array grows.</summary>
        internal ref T this[int index]
        {
            get
            {
                var all = pages;
                var page = index >> Bits;
                if (page < all.Length && all[page] is T[] found) return ref found[index & Mask];
                return ref Create(page)[index & Mask];
            }
        }

        private T[] Create(int page)
        {
            if (page >= pages.Length) Array.Resize(ref pages, Math.Max(page + 1, 2 * pages.Length));
            return pages[page] = new T[1 << Bits];
        }
    }
}
