using System;

namespace Collektive.Headless
{
    /// <summary>
    /// Sorts links by their slots. It uses a counting sort and reuses its memory, because a comparison sort is ten times slower and allocates.
    /// </summary>
    internal sealed class LinkSorter
    {
        private long[] other = new long[256];
        private int[] places = new int[64];

        /// <param name="keys">Keys in the format of <see cref="ReplayFrame.LinkKeys"/>.</param>
        /// <param name="count">Number of keys.</param>
        /// <param name="slots">A number that is greater than all slots.</param>
        internal void Sort(long[] keys, int count, int slots)
        {
            if (other.Length < count) other = new long[keys.Length];
            if (places.Length <= slots) places = new int[(slots + 1) * 2];
            Pass(keys, other, count, slots, 2);
            Pass(other, keys, count, slots, 26);
        }

        /// <summary>Copies the keys, sorted by one of their two slots. The sort is stable.</summary>
        private void Pass(long[] from, long[] to, int count, int slots, int shift)
        {
            Array.Clear(places, 0, slots + 1);
            for (var i = 0; i < count; i++) places[SlotOf(from[i], shift) + 1]++;
            for (var slot = 1; slot < slots; slot++) places[slot] += places[slot - 1];
            for (var i = 0; i < count; i++) to[places[SlotOf(from[i], shift)]++] = from[i];
        }

        private static int SlotOf(long key, int shift) => (int)(key >> shift) & 0xFFFFFF;
    }
}
