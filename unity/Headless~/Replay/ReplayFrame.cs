using System;

namespace Collektive.Headless
{
    /// <summary>One frame as it comes: by slot whether a node is there, its position in steps and its scalar; and its links.</summary>
    internal sealed class ReplayFrame
    {
        private bool[] present = new bool[0];
        private float[] scalars = new float[0];

        /// <summary>Slots in use up to this frame.</summary>
        internal int Slots { get; private set; }

        /// <summary>By axis and slot.</summary>
        internal int[][] Positions { get; } = { new int[0], new int[0], new int[0] };

        /// <summary>By slot, after <see cref="QuantiseScalars"/>: 0 for no value, else one more than the steps from the least.</summary>
        internal int[] ScalarSteps { get; private set; } = new int[0];

        /// <summary>Links that the frame has; <see cref="LinkCount"/> of them are kept.</summary>
        internal int Links { get; set; }

        internal int LinkCount { get; private set; }

        /// <summary>The lesser slot in the upper half. Sorted and each once after <see cref="End"/>.</summary>
        internal long[] LinkKeys { get; private set; } = new long[256];

        internal void Begin(int slots)
        {
            Reserve(slots);
            Slots = slots;
            Array.Clear(present, 0, present.Length);
            LinkCount = 0;
        }

        internal bool Has(int slot) => slot < present.Length && present[slot];

        internal void Set(int slot, int x, int y, int z, float scalar)
        {
            Reserve(slot + 1);
            Slots = Math.Max(Slots, slot + 1);
            present[slot] = true;
            Positions[0][slot] = x;
            Positions[1][slot] = y;
            Positions[2][slot] = z;
            scalars[slot] = scalar;
        }

        internal void Link(int slotA, int slotB)
        {
            if (LinkCount == LinkKeys.Length) LinkKeys = Larger(LinkKeys, LinkCount * 2);
            LinkKeys[LinkCount++] = slotA < slotB ? (long)slotA << 32 | (uint)slotB : (long)slotB << 32 | (uint)slotA;
        }

        /// <summary>Sorts the links and returns how many are kept.</summary>
        internal int End(LinkSorter sorter)
        {
            sorter.Sort(LinkKeys, LinkCount, Slots);
            var distinct = 0;
            for (var i = 0; i < LinkCount; i++)
                if (i == 0 || LinkKeys[i] != LinkKeys[i - 1]) LinkKeys[distinct++] = LinkKeys[i];
            LinkCount = distinct;
            return distinct;
        }

        /// <summary>Widens a range by the frame's scalars.</summary>
        internal void WidenScalars(ref float min, ref float max)
        {
            for (var slot = 0; slot < Slots; slot++)
            {
                if (!present[slot]) continue;
                // Neither is true of NaN.
                if (scalars[slot] < min) min = scalars[slot];
                if (scalars[slot] > max) max = scalars[slot];
            }
        }

        internal void QuantiseScalars(float min, double scale)
        {
            for (var slot = 0; slot < Slots; slot++)
            {
                if (!present[slot]) continue;
                var value = scalars[slot];
                ScalarSteps[slot] = float.IsNaN(value) ? 0 : 1 + (int)(((double)value - min) * scale + 0.5);
            }
        }

        private void Reserve(int slots)
        {
            if (slots <= present.Length) return;
            var size = Math.Max(64, Math.Max(slots, present.Length * 2));
            present = Larger(present, size);
            scalars = Larger(scalars, size);
            ScalarSteps = Larger(ScalarSteps, size);
            for (var axis = 0; axis < 3; axis++) Positions[axis] = Larger(Positions[axis], size);
        }

        private static T[] Larger<T>(T[] array, int size)
        {
            Array.Resize(ref array, size);
            return array;
        }
    }
}
