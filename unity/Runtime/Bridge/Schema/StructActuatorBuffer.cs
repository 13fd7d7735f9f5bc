using System;
using System.Runtime.InteropServices;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Actuator data that is a struct in the schema: all elements come out of the frame by one block copy, as sensor data go in. Looking up each one in the
    /// frame's memory costs Mono ten times as much.
    /// </summary>
    public sealed class StructActuatorBuffer<T> : ActuatorBuffer<T> where T : unmanaged, IMirror
    {
        private T[] items = Array.Empty<T>();

        /// <inheritdoc/>
        public override T this[int index]
        {
            get
            {
                Require(index);
                return items[index];
            }
        }

        private protected override unsafe int ElementSize => sizeof(T);

        private protected override void Show(ByteBuffer frame, int first, int elements)
        {
            if (elements > items.Length) items = new T[Math.Max(elements, 2 * items.Length)];
            if (elements > 0) frame.ToSpan(first, elements * ElementSize).CopyTo(MemoryMarshal.AsBytes(new Span<T>(items)));
        }
    }
}
