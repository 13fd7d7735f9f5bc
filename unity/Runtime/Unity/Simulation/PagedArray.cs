using System;

namespace Collektive.Unity
{
    /// <summary>Values by index, 0 or greater, in pages that are created on first use. A large index needs no memory for all smaller ones.</summary>
    internal sealed class PagedArray<T>
    {
        private const int Bits = 7;
        private const int Mask = (1 << Bits) - 1;

        private T[][] pages = new T[4][];

        /// <summary>The value, initially the default. The reference stays valid.</summary>
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
