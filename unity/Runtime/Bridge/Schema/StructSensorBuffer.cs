using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Sensor data that is a struct in the schema. All elements are copied into the frame as one block.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class StructSensorBuffer<T> : SensorBuffer<T> where T : unmanaged, IMirror
    {
        private readonly int alignment;

        /// <summary>Creates an empty buffer. <paramref name="alignment"/> is the struct's alignment in bytes.</summary>
        public StructSensorBuffer(int alignment)
        {
            this.alignment = alignment;
        }

        /// <inheritdoc/>
        internal override void Clear(int index)
        {
            Items[index] = default;
        }

        /// <inheritdoc/>
        internal override string FindNotFinite(int index) => Items[index].FindNotFinite();

        /// <inheritdoc/>
        internal override int Write(FlatBufferBuilder builder, int count)
        {
            return FrameTable.Write(builder, count == 0 ? 0 : Blit.Vector(builder, Items, count, alignment));
        }
    }
}
