using System;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Buffer for the sensor data of one tick. Element i belongs to the i-th due node. Not thread-safe; allocates only while its capacity grows.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class SensorBuffer
    {
        /// <summary>The type of an element, the T of a <c>Sensor&lt;T&gt;</c>.</summary>
        internal abstract Type DataType { get; }

        /// <summary>Ensures capacity for at least this many elements. Never shrinks.</summary>
        internal abstract void EnsureCapacity(int count);

        /// <summary>Returns an element, boxed, for tools that do not know the schema's types.</summary>
        internal abstract object Get(int index);

        /// <summary>Sets an element to the defaults of the schema.</summary>
        internal abstract void Clear(int index);

        /// <summary>
        /// Returns the path of the element's first field that is NaN or infinite, such as <c>points[2].x</c>, or null. A field whose default in the schema
        /// is not finite may contain such values and is not checked.
        /// </summary>
        internal abstract string FindNotFinite(int index);

        /// <summary>Writes the first <paramref name="count"/> elements, and returns the offset of the table <c>Sensors</c>.</summary>
        /// <exception cref="BridgeException">A required field was not set: <see cref="BridgeError.Argument"/>.</exception>
        internal abstract int Write(FlatBufferBuilder builder, int count);
    }

    /// <summary>A <see cref="SensorBuffer"/> with typed elements.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class SensorBuffer<T> : SensorBuffer
    {
        /// <summary>The elements; <see cref="SensorBuffer.EnsureCapacity"/> may replace the array.</summary>
        internal T[] Items = Array.Empty<T>();

        /// <inheritdoc/>
        internal sealed override Type DataType => typeof(T);

        /// <inheritdoc/>
        internal sealed override object Get(int index) => Items[index];

        /// <inheritdoc/>
        internal override void EnsureCapacity(int count)
        {
            if (count > Items.Length) Array.Resize(ref Items, Math.Max(count, 2 * Items.Length));
        }
    }
}
