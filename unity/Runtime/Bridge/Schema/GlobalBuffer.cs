using System;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Buffer for the global data. Not thread-safe; allocates only while its capacity grows.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class GlobalBuffer
    {
        /// <summary>The type of the staged data.</summary>
        internal abstract Type DataType { get; }

        /// <summary>Sets all fields to the defaults of the schema.</summary>
        internal abstract void Clear();

        /// <summary>Like <see cref="SensorBuffer.FindNotFinite"/>.</summary>
        internal abstract string FindNotFinite();

        /// <summary>Writes the data, and returns the offset of the table <c>GlobalData</c>.</summary>
        /// <exception cref="BridgeException">A required field was not set: <see cref="BridgeError.Argument"/>.</exception>
        internal abstract int Write(FlatBufferBuilder builder);
    }

    /// <summary>A <see cref="GlobalBuffer"/> with typed data.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class GlobalBuffer<T> : GlobalBuffer
    {
        /// <summary>The staged data.</summary>
        internal T Data;

        /// <inheritdoc/>
        internal sealed override Type DataType => typeof(T);
    }
}
