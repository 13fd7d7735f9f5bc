using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>The offsets of a table's fields in the rows that <see cref="Draft{TRow}"/> writes. Used by generated code.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class RowLayout
    {
        /// <summary>
        /// Creates a layout from the row's alignment, the row's size, and the offset of each slot of the schema, all in bytes. Deprecated slots have offset 0.
        /// </summary>
        public RowLayout(int alignment, int bytes, params ushort[] offsets)
        {
            Alignment = alignment;
            Bytes = bytes;
            Offsets = offsets;
        }

        internal int Alignment { get; }

        internal int Bytes { get; }

        internal ushort[] Offsets { get; }
    }
}
