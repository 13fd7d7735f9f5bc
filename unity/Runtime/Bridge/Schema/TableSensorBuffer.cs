using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Sensor data that is a table in the schema: staged in one reused draft per element.</summary>
    public sealed class TableSensorBuffer<T> : SensorBuffer<T> where T : Draft, new()
    {
        private readonly DraftWriter writer = new DraftWriter();

        /// <inheritdoc/>
        public override void EnsureCapacity(int count)
        {
            var old = Items.Length;
            base.EnsureCapacity(count);
            for (var i = old; i < Items.Length; i++) Items[i] = new T();
        }

        /// <inheritdoc/>
        public override void Clear(int index)
        {
            Items[index].Clear();
        }

        /// <inheritdoc/>
        public override string FindNotFinite(int index) => Items[index].FindNotFinite();

        /// <inheritdoc/>
        public override int Write(FlatBufferBuilder builder, int count)
        {
            writer.Begin(builder);
            for (var i = 0; i < count; i++)
            {
                writer.Place = i;
                writer.Push(Items[i].Write(writer));
            }
            return FrameTable.Write(builder, writer.PopVector(count));
        }
    }
}
