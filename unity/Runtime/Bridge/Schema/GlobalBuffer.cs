using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Staging of the global data that all nodes see. Not thread-safe; no allocation once the capacities are reached.</summary>
    public abstract class GlobalBuffer
    {
        /// <summary>The type of the staged data.</summary>
        public abstract Type DataType { get; }

        /// <summary>Gives all fields the defaults of the schema.</summary>
        public abstract void Clear();

        /// <summary>Like <see cref="SensorBuffer.FindNotFinite"/>.</summary>
        public abstract string FindNotFinite();

        /// <summary>Writes the data; the offset of the table <c>GlobalData</c>.</summary>
        /// <exception cref="BridgeException">A required field was not set: <see cref="BridgeError.Argument"/>.</exception>
        public abstract int Write(FlatBufferBuilder builder);
    }

    /// <summary>A <see cref="GlobalBuffer"/> with typed data.</summary>
    public abstract class GlobalBuffer<T> : GlobalBuffer
    {
        /// <summary>The staged data.</summary>
        public T Data;

        /// <inheritdoc/>
        public sealed override Type DataType => typeof(T);
    }
}
