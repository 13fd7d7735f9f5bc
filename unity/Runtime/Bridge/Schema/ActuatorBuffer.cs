using System;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Reads the actuator data of this tick and of the previous one. Not thread-safe; no allocation once the capacities are reached.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class ActuatorBuffer
    {
        /// <summary>The type of an element, the T of an <c>Actuator&lt;T&gt;</c>.</summary>
        internal abstract Type DataType { get; }

        /// <summary>
        /// Points this reader at the table <c>Actuators</c> at <paramref name="position"/> (bytes from the start) of
        /// <paramref name="frame"/>. Valid until the session's next call.
        /// </summary>
        /// <exception cref="BridgeException">The table does not fit the frame: <see cref="BridgeError.Frame"/>.</exception>
        internal abstract void Attach(ByteBuffer frame, int position);

        /// <summary>Number of elements in the attached table.</summary>
        internal abstract int Count { get; }

        /// <summary>The element at an index below <see cref="Count"/>, boxed, for tools without the schema's types.</summary>
        internal abstract object Get(int index);

        /// <summary>As <see cref="Get"/>, for the previously attached table.</summary>
        internal abstract object GetPrevious(int index);

        /// <summary>
        /// Copies an element of the previously attached table. Reuses the memory of <paramref name="kept"/> unless it is null.
        /// </summary>
        internal abstract void CopyPrevious(int index, ref AnswerCopy kept);

        /// <summary>
        /// Called by a session before the attached frame's memory is overwritten. Until the next <see cref="Attach"/>, the attached elements can still be read,
        /// but the previous ones cannot. <see cref="Attach"/> then makes them the previous ones.
        /// </summary>
        internal abstract void Retain();
    }

    /// <summary>An <see cref="ActuatorBuffer"/> with typed elements.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class ActuatorBuffer<T> : ActuatorBuffer
    {
        private int count;
        private int previousCount;

        /// <inheritdoc/>
        internal sealed override Type DataType => typeof(T);

        /// <inheritdoc/>
        internal sealed override int Count => count;

        /// <inheritdoc/>
        internal sealed override object Get(int index) => this[index];

        /// <inheritdoc/>
        internal sealed override object GetPrevious(int index) => Previous(index);

        /// <summary>The element at an index below <see cref="ActuatorBuffer.Count"/>.</summary>
        internal abstract T this[int index] { get; }

        /// <summary>
        /// An element of the previously attached table, at an index below its count. Valid as long as the elements of the attached table.
        /// </summary>
        internal abstract T Previous(int index);

        /// <inheritdoc/>
        internal sealed override void Attach(ByteBuffer frame, int position)
        {
            var first = FrameTable.FindData(frame, position, ElementSize, out var elements);
            Show(frame, first, elements);
            previousCount = count;
            count = elements;
        }

        /// <summary>Bytes of an element in the vector.</summary>
        private protected abstract int ElementSize { get; }

        /// <summary>Reads the elements of a vector from <paramref name="first"/> on. The present elements become the previous ones.</summary>
        private protected abstract void Show(ByteBuffer frame, int first, int elements);

        private protected void Require(int index)
        {
            if ((uint)index >= (uint)count) throw new ArgumentOutOfRangeException(nameof(index));
        }

        private protected void RequirePrevious(int index)
        {
            if ((uint)index >= (uint)previousCount) throw new ArgumentOutOfRangeException(nameof(index));
        }
    }
}
