using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Reads one tick's actuator data. Not thread-safe; no allocation once the capacities are reached.</summary>
    public abstract class ActuatorBuffer
    {
        /// <summary>The type of an element: what an <c>Actuator&lt;T&gt;</c> must have as its T.</summary>
        public abstract Type DataType { get; }

        /// <summary>
        /// Points this reader at the table <c>Actuators</c> at <paramref name="position"/> (bytes from the start) of
        /// <paramref name="frame"/>. Valid until the session's next call.
        /// </summary>
        /// <exception cref="BridgeException">The table does not fit the frame: <see cref="BridgeError.Frame"/>.</exception>
        public abstract void Attach(ByteBuffer frame, int position);

        /// <summary>Elements in the attached table.</summary>
        public abstract int Count { get; }

        /// <summary>The element at an index below <see cref="Count"/>, boxed: for tools that know no schema.</summary>
        public abstract object Get(int index);
    }

    /// <summary>An <see cref="ActuatorBuffer"/> with typed elements.</summary>
    public abstract class ActuatorBuffer<T> : ActuatorBuffer
    {
        private int count;

        /// <inheritdoc/>
        public sealed override Type DataType => typeof(T);

        /// <inheritdoc/>
        public sealed override int Count => count;

        /// <inheritdoc/>
        public sealed override object Get(int index) => this[index];

        /// <summary>The element at an index below <see cref="ActuatorBuffer.Count"/>.</summary>
        public abstract T this[int index] { get; }

        /// <inheritdoc/>
        public sealed override void Attach(ByteBuffer frame, int position)
        {
            var first = FrameTable.FindData(frame, position, ElementSize, out var elements);
            Show(frame, first, elements);
            count = elements;
        }

        /// <summary>Bytes of an element in the vector.</summary>
        private protected abstract int ElementSize { get; }

        /// <summary>Takes over the elements of a vector; the first one begins at <paramref name="first"/>.</summary>
        private protected abstract void Show(ByteBuffer frame, int first, int elements);

        private protected void Require(int index)
        {
            if ((uint)index >= (uint)count) throw new ArgumentOutOfRangeException(nameof(index));
        }
    }
}
