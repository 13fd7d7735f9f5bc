using System;
using System.ComponentModel;
using System.Runtime.InteropServices;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Actuator data that is a struct in the schema. All elements are copied from the frame as one block. Reading each element from the frame's memory
    /// would take ten times as long on Mono.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class StructActuatorBuffer<T> : ActuatorBuffer<T> where T : unmanaged, IMirror
    {
        private T[] items = Array.Empty<T>();
        private T[] previous = Array.Empty<T>();

        /// <inheritdoc/>
        internal override T this[int index]
        {
            get
            {
                Require(index);
                return items[index];
            }
        }

        /// <inheritdoc/>
        internal override T Previous(int index)
        {
            RequirePrevious(index);
            return previous[index];
        }

        /// <inheritdoc/>
        internal override void CopyPrevious(int index, ref AnswerCopy copy)
        {
            if (copy == null) copy = new StructCopy();
            ((StructCopy)copy).Item = Previous(index);
        }

        /// <summary>Does nothing, because elements are copies.</summary>
        internal override void Retain()
        {
        }

        private protected override unsafe int ElementSize => sizeof(T);

        private protected override void Show(ByteBuffer frame, int first, int elements)
        {
            var next = previous;
            previous = items;
            items = elements > next.Length ? new T[Math.Max(elements, 2 * next.Length)] : next;
            if (elements > 0) frame.ToSpan(first, elements * ElementSize).CopyTo(MemoryMarshal.AsBytes(new Span<T>(items)));
        }

        private sealed class StructCopy : AnswerCopy<T>
        {
            internal T Item;

            public override T Value => Item;
        }
    }
}
