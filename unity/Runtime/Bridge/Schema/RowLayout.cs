using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>The offsets of a table's fields in its rows: see <see cref="Draft{TRow}"/>. Used by generated code.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class RowLayout
    {
        /// <summary>
        /// Creates a layout from the row's alignment, its size, and the offset of each slot of the schema in bytes; 0 for deprecated slots.
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
