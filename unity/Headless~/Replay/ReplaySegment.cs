using System;
using System.Collections.Generic;

namespace Collektive.Headless
{
    /// <summary>Frames that are encoded together. Each frame is stored as its difference from the previous one (FORMAT.md, Segment).</summary>
    internal sealed class ReplaySegment
    {
        private const int Axes = 3;
        private const int NumberSteps = 65534;
        private const long MaxExactInteger = 1L << 52;
        private const int MaxBytesPerNumber = 5;

        private readonly ReplayFrame[] frames = new ReplayFrame[ReplayWriter.FramesPerSegment];
        private readonly ReplayField[] fields;
        private readonly double[] scales;
        private readonly double[] minimum;
        // Indexed by column (x, y and z, followed by the fields) and slot.
        private readonly int[][] last;
        private readonly int[][] motion;
        private bool[] hasPrevious = new bool[0];
        private byte[] bytes = new byte[1 << 12];
        private int length;

        internal ReplaySegment(ReplayField[] fields)
        {
            this.fields = fields;
            scales = new double[fields.Length];
            minimum = new double[fields.Length];
            last = new int[Axes + fields.Length][];
            motion = new int[Axes + fields.Length][];
            for (var column = 0; column < last.Length; column++) last[column] = motion[column] = new int[0];
        }

        /// <summary>Number of frames since the last <see cref="Encode"/>.</summary>
        internal int Count { get; private set; }

        /// <summary>Returns the next frame, which is empty.</summary>
        /// <param name="slots">Slots in use before the frame.</param>
        internal ReplayFrame Add(int slots)
        {
            var frame = frames[Count] = frames[Count] ?? new ReplayFrame(fields);
            Count++;
            frame.Begin(slots);
            return frame;
        }

        /// <summary>Encodes the frames and removes them.</summary>
        /// <param name="ids">The id of the node in each slot.</param>
        /// <param name="coded">The encoded segment; valid until the next call.</param>
        /// <returns>Length of the segment in bytes.</returns>
        internal int Encode(List<int> ids, out byte[] coded)
        {
            length = 0;
            Reset(frames[Count - 1].Slots);
            for (var field = 0; field < fields.Length; field++) WriteRange(field);
            WriteIds(ids);
            for (var i = 0; i < Count; i++)
            {
                var frame = frames[i];
                WritePresence(frame);
                for (var axis = 0; axis < 3; axis++) WriteColumn(frame, frame.Positions[axis], last[axis], motion[axis]);
                for (var field = 0; field < fields.Length; field++)
                {
                    frame.Quantise(field, minimum[field], scales[field]);
                    WriteColumn(frame, frame.Steps[field], last[Axes + field], motion[Axes + field]);
                }
                for (var slot = 0; slot < frame.Slots; slot++) hasPrevious[slot] |= frame.Has(slot);
                WriteLinks(i == 0 ? null : frames[i - 1], frame);
            }
            Count = 0;
            coded = bytes;
            return length;
        }

        private void Reset(int slots)
        {
            if (hasPrevious.Length < slots)
            {
                hasPrevious = new bool[slots];
                for (var column = 0; column < last.Length; column++)
                {
                    last[column] = new int[slots];
                    motion[column] = new int[slots];
                }
            }
            Array.Clear(hasPrevious, 0, slots);
            for (var column = 0; column < last.Length; column++)
            {
                Array.Clear(last[column], 0, slots);
                Array.Clear(motion[column], 0, slots);
            }
        }

        private void WriteRange(int field)
        {
            if (fields[field].Kind != ReplayFieldKind.Number) return;
            double min = double.PositiveInfinity, max = double.NegativeInfinity;
            var isWhole = true;
            for (var i = 0; i < Count; i++) isWhole &= frames[i].Widen(field, ref min, ref max);
            if (min > max) min = max = 0;
            // Small numbers beside Int.MAX_VALUE, for example, would otherwise become equal.
            if (isWhole && max - min < uint.MaxValue && Math.Abs(min) < MaxExactInteger) max = min + NumberSteps;
            // The scale of a smaller range would be infinite.
            if (double.IsInfinity(NumberSteps / (max - min))) max = min;
            Reserve(16);
            WriteDouble(min);
            WriteDouble(max);
            minimum[field] = min;
            scales[field] = max > min ? NumberSteps / (max - min) : 0;
        }

        private void WriteIds(List<int> ids)
        {
            Reserve(MaxBytesPerNumber * (1 + ids.Count));
            WriteNumber((uint)ids.Count);
            for (var slot = 0; slot < ids.Count; slot++) WriteSigned(unchecked(ids[slot] - (slot == 0 ? 0 : ids[slot - 1])));
        }

        private void WritePresence(ReplayFrame frame)
        {
            Reserve(MaxBytesPerNumber + frame.Slots / 8 + 1);
            WriteNumber((uint)frame.Slots);
            for (var first = 0; first < frame.Slots; first += 8)
            {
                var bits = 0;
                for (var slot = first; slot < frame.Slots && slot < first + 8; slot++)
                    if (frame.Has(slot)) bits |= 1 << (slot - first);
                bytes[length++] = (byte)bits;
            }
        }

        /// <summary>Writes the difference between each value and its linear prediction. All sums wrap around.</summary>
        private void WriteColumn(ReplayFrame frame, int[] values, int[] last, int[] motion)
        {
            Reserve(MaxBytesPerNumber * frame.Slots);
            unchecked
            {
                for (var slot = 0; slot < frame.Slots; slot++)
                {
                    if (!frame.Has(slot)) continue;
                    var step = values[slot] - last[slot];
                    var residual = step - motion[slot];
                    WriteSigned(residual);
                    last[slot] = values[slot];
                    if (hasPrevious[slot]) motion[slot] = step;
                }
            }
        }

        private void WriteLinks(ReplayFrame before, ReplayFrame frame)
        {
            Reserve(MaxBytesPerNumber * (3 + 2 * (frame.PairCount + (before?.PairCount ?? 0))));
            WriteNumber((uint)frame.Links);
            var shared = before == null ? 0 : CountShared(before, frame);
            // Removed pairs come first, then added pairs.
            if (before == null) WriteNumber(0);
            else WritePairs(before, frame, shared);
            WritePairs(frame, before, shared);
        }

        private static int CountShared(ReplayFrame one, ReplayFrame other)
        {
            long[] keys = one.LinkKeys, otherKeys = other.LinkKeys;
            int count = 0, i = 0, j = 0;
            while (i < one.PairCount && j < other.PairCount)
            {
                var difference = keys[i] - otherKeys[j];
                if (difference <= 0) i++;
                if (difference >= 0) j++;
                if (difference == 0) count++;
            }
            return count;
        }

        /// <summary>Writes the pairs of a frame that another frame does not contain.</summary>
        /// <param name="shared">Number of pairs in both frames.</param>
        private void WritePairs(ReplayFrame frame, ReplayFrame excluded, int shared)
        {
            WriteNumber((uint)(frame.PairCount - shared));
            if (frame.PairCount == shared) return;
            long[] keys = frame.LinkKeys, excludedKeys = excluded?.LinkKeys;
            int excludedCount = excluded?.PairCount ?? 0, other = 0, a = -1, b = 0;
            for (var i = 0; i < frame.PairCount; i++)
            {
                var key = keys[i];
                while (other < excludedCount && excludedKeys[other] < key) other++;
                if (other < excludedCount && excludedKeys[other] == key) continue;
                int nextA = (int)(key >> 26), nextB = (int)(key >> 2) & 0xFFFFFF;
                WriteNumber((uint)(nextA - a));
                WriteNumber((uint)((nextB - (nextA == a ? b : nextA)) << 2 | (int)key & 3));
                a = nextA;
                b = nextB;
            }
        }

        private void WriteSigned(int value) => WriteNumber((uint)(value << 1 ^ value >> 31));

        private void WriteNumber(uint value)
        {
            for (; value >= 0x80; value >>= 7) bytes[length++] = (byte)(value | 0x80);
            bytes[length++] = (byte)value;
        }

        private void WriteDouble(double value)
        {
            var bits = BitConverter.DoubleToInt64Bits(value);
            for (var shift = 0; shift < 64; shift += 8) bytes[length++] = (byte)(bits >> shift);
        }

        private void Reserve(int more)
        {
            if (length + more > bytes.Length) Array.Resize(ref bytes, Math.Max(length + more, bytes.Length * 2));
        }
    }
}
