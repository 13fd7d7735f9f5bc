using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Buffer for global data, which is always a table. It reuses one draft.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class TableGlobalBuffer<T> : GlobalBuffer<T> where T : Draft, new()
    {
        private readonly DraftWriter writer = new DraftWriter();

        /// <summary>Creates a buffer with the defaults of the schema.</summary>
        public TableGlobalBuffer()
        {
            Data = new T();
        }

        /// <inheritdoc/>
        internal override void Clear()
        {
            Data.Clear();
        }

        /// <inheritdoc/>
        internal override string FindNotFinite() => Data.FindNotFinite();

        /// <inheritdoc/>
        internal override int Write(FlatBufferBuilder builder)
        {
            writer.Begin(builder);
            var offset = Data.Write(writer);
            writer.End();
            return offset;
        }
    }
}
