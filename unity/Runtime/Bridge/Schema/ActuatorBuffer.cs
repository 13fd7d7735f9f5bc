using System;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Reads the actuator data of this tick and of the previous tick. Not thread-safe; allocates only while its capacity grows.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class ActuatorBuffer
    {
        /// <summary>The type of an element, the T of an <c>Actuator&lt;T&gt;</c>.</summary>
        internal abstract Type DataType { get; }

        /// <summary>
        /// Attaches the table <c>Actuators</c> at <paramref name="position"/> (in bytes from the start) of <paramref name="frame"/>. Its elements are valid
        /// until the session's next call.
        /// </summary>
        /// <exception cref="BridgeException">The table lies outside of the frame: <see cref="BridgeError.Frame"/>.</exception>
        internal abstract void Attach(ByteBuffer frame, int position);

        /// <summary>Number of elements in the attached table.</summary>
        internal abstract int Count { get; }

        /// <summary>Returns the element at an index below <see cref="Count"/>, boxed, for tools that do not know the schema's types.</summary>
        internal abstract object Get(int index);

        /// <summary>Returns an element of the previously attached table, boxed.</summary>
        internal abstract object GetPrevious(int index);

        /// <summary>
        /// Copies an element of the previously attached table. Reuses the memory of <paramref name="copy"/> unless it is null.
        /// </summary>
        internal abstract void CopyPrevious(int index, ref AnswerCopy copy);

        /// <summary>
        /// Called by a session before the attached frame's memory is overwritten. The elements of that frame remain readable, and become the previous ones
        /// with the next <see cref="Attach"/>. Until then, do not call <see cref="CopyPrevious"/>.
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
        /// Returns an element of the previously attached table, at an index below that table's count. It is valid as long as the elements of the attached
        /// table.
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

        /// <summary>Attaches the elements of a vector that begins at <paramref name="first"/>. The elements attached so far become the previous ones.</summary>
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
