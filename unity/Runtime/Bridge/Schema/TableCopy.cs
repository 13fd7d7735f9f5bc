using System;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>A copy of a frame's table with its children. Allocates only while its capacity grows.</summary>
    internal sealed class TableCopy
    {
        /// <summary>The largest alignment of a FlatBuffers number.</summary>
        private const int Alignment = sizeof(ulong);

        private byte[] bytes = new byte[64];
        private int used;

        internal TableCopy()
        {
            Buffer = new ByteBuffer(bytes);
        }

        /// <summary>The copied bytes.</summary>
        internal ByteBuffer Buffer { get; private set; }

        internal void Clear() => used = 0;

        /// <summary>Appends a copy of bytes with the same alignment, and returns its position.</summary>
        internal int Add(ByteBuffer from, int start, int length)
        {
            var position = used + (start - used & Alignment - 1);
            used = checked(position + length);
            if (used > bytes.Length)
            {
                Array.Resize(ref bytes, Math.Max(used, 2 * bytes.Length));
                Buffer = new ByteBuffer(bytes);
            }
            from.ToSpan(start, length).CopyTo(new Span<byte>(bytes, position, length));
            return position;
        }
    }
}
