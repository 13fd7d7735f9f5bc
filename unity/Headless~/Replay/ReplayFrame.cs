using System;

namespace Collektive.Headless
{
    /// <summary>One frame with its links. For each slot, it stores whether a node is present, and the node's position in steps and values.</summary>
    internal sealed class ReplayFrame
    {
        private bool[] present = new bool[0];
        private readonly ReplayField[] fields;
        private readonly double[][] values;

        internal ReplayFrame(ReplayField[] fields)
        {
            this.fields = fields;
            values = new double[fields.Length][];
            Steps = new int[fields.Length][];
            for (var field = 0; field < fields.Length; field++)
            {
                values[field] = new double[0];
                Steps[field] = new int[0];
            }
        }

        /// <summary>Number of slots in use up to this frame.</summary>
        internal int Slots { get; private set; }

        /// <summary>Positions in steps, by axis and slot.</summary>
        internal int[][] Positions { get; } = { new int[0], new int[0], new int[0] };

        /// <summary>Values by field and slot, set by <see cref="Quantise"/>: 0 if the value is missing, otherwise coded as in FORMAT.md.</summary>
        internal int[][] Steps { get; }

        /// <summary>Number of links in the frame, each direction counted.</summary>
        internal int Links { get; set; }

        /// <summary>Number of stored pairs of linked nodes.</summary>
        internal int PairCount { get; private set; }

        /// <summary>
        /// The keys of the linked pairs, sorted and unique after <see cref="End"/>. Bits from 26 on contain the lower slot of a pair, and bits 2 to 25 the
        /// higher slot. Bit 0 is set for a link to the higher slot, and bit 1 for a link to the lower slot.
        /// </summary>
        internal long[] LinkKeys { get; private set; } = new long[256];

        internal void Begin(int slots)
        {
            Reserve(slots);
            Slots = slots;
            Array.Clear(present, 0, present.Length);
            PairCount = 0;
        }

        internal bool Has(int slot) => slot < present.Length && present[slot];

        internal void Set(int slot, int x, int y, int z)
        {
            Reserve(slot + 1);
            Slots = Math.Max(Slots, slot + 1);
            present[slot] = true;
            Positions[0][slot] = x;
            Positions[1][slot] = y;
            Positions[2][slot] = z;
            foreach (var column in values) column[slot] = double.NaN;
        }

        internal void SetValue(int field, int slot, double value) => values[field][slot] = value;

        internal void Link(int from, int to, bool isMutual)
        {
            if (PairCount == LinkKeys.Length) LinkKeys = Larger(LinkKeys, PairCount * 2);
            var direction = isMutual ? 3 : from < to ? 1 : 2;
            LinkKeys[PairCount++] = (long)Math.Min(from, to) << 26 | (long)Math.Max(from, to) << 2 | (uint)direction;
        }

        /// <summary>Sorts the links and merges the links of each pair. Returns the number of stored links, each direction counted.</summary>
        internal int End(LinkSorter sorter)
        {
            sorter.Sort(LinkKeys, PairCount, Slots);
            int pairs = 0, links = 0;
            for (var i = 0; i < PairCount; i++)
            {
                if (pairs > 0 && LinkKeys[pairs - 1] >> 2 == LinkKeys[i] >> 2) LinkKeys[pairs - 1] |= LinkKeys[i];
                else LinkKeys[pairs++] = LinkKeys[i];
            }
            PairCount = pairs;
            for (var i = 0; i < pairs; i++) links += (LinkKeys[i] & 3) == 3 ? 2 : 1;
            return links;
        }

        /// <summary>Extends a range to include the frame's values of a field. Returns whether all values are whole numbers.</summary>
        internal bool Widen(int field, ref double min, ref double max)
        {
            var isWhole = true;
            for (var slot = 0; slot < Slots; slot++)
            {
                if (!present[slot]) continue;
                var value = values[field][slot];
                // Both comparisons are false for NaN.
                if (value < min) min = value;
                if (value > max) max = value;
                isWhole &= value == Math.Floor(value) || double.IsNaN(value);
            }
            return isWhole;
        }

        /// <summary>Converts a field's values to steps. Steps of numbers start at the smallest value.</summary>
        internal void Quantise(int field, double min, double scale)
        {
            var isNumber = fields[field].Kind == ReplayFieldKind.Number;
            for (var slot = 0; slot < Slots; slot++)
            {
                if (!present[slot]) continue;
                var value = values[field][slot];
                Steps[field][slot] = double.IsNaN(value) ? 0 : isNumber ? (int)(long)((value - min) * scale + 1.5) : 1 + Signed((int)value);
            }
        }

        private static int Signed(int value) => value << 1 ^ value >> 31;

        private void Reserve(int slots)
        {
            if (slots <= present.Length) return;
            var size = Math.Max(64, Math.Max(slots, present.Length * 2));
            present = Larger(present, size);
            for (var field = 0; field < values.Length; field++)
            {
                values[field] = Larger(values[field], size);
                Steps[field] = Larger(Steps[field], size);
            }
            for (var axis = 0; axis < 3; axis++) Positions[axis] = Larger(Positions[axis], size);
        }

        private static T[] Larger<T>(T[] array, int size)
        {
            Array.Resize(ref array, size);
            return array;
        }
    }
}
