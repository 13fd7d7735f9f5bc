using System;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Sensor data that is a table in the schema. Each element has a draft that is reused. All tables are copied to the frame as one block.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class TableSensorBuffer<TDraft, TRow> : SensorBuffer<TDraft> where TDraft : Draft<TRow>, new() where TRow : unmanaged
    {
        private readonly DraftWriter writer = new DraftWriter();
        private int[] vtables = Array.Empty<int>();

        /// <inheritdoc/>
        internal override void EnsureCapacity(int count)
        {
            var old = Items.Length;
            base.EnsureCapacity(count);
            if (Items.Length == old) return;
            for (var i = old; i < Items.Length; i++) Items[i] = new TDraft();
            vtables = new int[Items.Length];
        }

        /// <inheritdoc/>
        internal override void Clear(int index)
        {
            Items[index].Clear();
        }

        /// <inheritdoc/>
        internal override string FindNotFinite(int index) => Items[index].FindNotFinite();

        /// <inheritdoc/>
        internal override int Write(FlatBufferBuilder builder, int count)
        {
            if (count == 0) return FrameTable.Write(builder, 0);
            var drafts = Items;
            writer.Begin(builder);
            for (var i = 0; i < count; i++)
            {
                writer.Element = i;
                vtables[i] = writer.VTable(drafts[i].Layout, drafts[i].WriteChildren(writer));
            }
            var data = writer.Rows<TDraft, TRow>(drafts, vtables, count);
            writer.End();
            return FrameTable.Write(builder, data);
        }
    }
}
