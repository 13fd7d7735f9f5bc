using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Sensor data that is a table in the schema: staged in one reused draft per element; all tables go into the frame by one block copy.</summary>
    public sealed class TableSensorBuffer<TDraft, TRow> : SensorBuffer<TDraft> where TDraft : Draft<TRow>, new() where TRow : unmanaged
    {
        private readonly DraftWriter writer = new DraftWriter();
        private TRow[] rows = Array.Empty<TRow>();
        private int[] vtables = Array.Empty<int>();

        /// <inheritdoc/>
        public override void EnsureCapacity(int count)
        {
            var old = Items.Length;
            base.EnsureCapacity(count);
            if (Items.Length == old) return;
            for (var i = old; i < Items.Length; i++) Items[i] = new TDraft();
            rows = new TRow[Items.Length];
            vtables = new int[Items.Length];
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
                vtables[i] = writer.VTable(Items[i].Layout, Items[i].WriteChildren(writer));
            }
            if (count > 0) WriteRows(builder, count);
            return FrameTable.Write(builder, writer.PopVector(count));
        }

        private unsafe void WriteRows(FlatBufferBuilder builder, int count)
        {
            builder.Prep(Items[0].Layout.Alignment, count * sizeof(TRow));
            var place = builder.Offset + count * sizeof(TRow);
            for (var i = 0; i < count; i++)
            {
                Items[i].Fill(ref rows[i], vtables[i], place);
                writer.Push(place);
                place -= sizeof(TRow);
            }
            fixed (TRow* first = rows) builder.Put<byte>((IntPtr)first, count * sizeof(TRow));
        }
    }
}
