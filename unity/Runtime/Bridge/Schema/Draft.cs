using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>
    /// Collects the fields of one table before it is written. Several sensors may fill different fields of a table, in any order, but FlatBuffers requires
    /// the children of a table before the table itself. Reused every tick; not thread-safe.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class Draft
    {
        /// <summary>Sets all fields to the defaults of the schema. Lists keep their capacity.</summary>
        public abstract void Clear();

        /// <summary>Returns the path of the first field that is NaN or infinite, or null.</summary>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public abstract string FindNotFinite();

        /// <summary>Writes the table after its children, and returns its offset. Called by the buffers.</summary>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public abstract int Write(DraftWriter writer);
    }

    /// <summary>
    /// A <see cref="Draft"/> whose table is stored in the frame as one block of type <typeparamref name="TRow"/>. The block has room for all fields, even
    /// absent ones. Used by generated code.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class Draft<TRow> : Draft where TRow : unmanaged
    {
        /// <summary>Creates a draft with the row layout <paramref name="layout"/>.</summary>
        protected Draft(RowLayout layout)
        {
            Layout = layout;
        }

        internal RowLayout Layout { get; }

        /// <summary>Writes the children of the table and stores their offsets. Returns a bit mask of the absent slots.</summary>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public abstract ulong WriteChildren(DraftWriter writer);

        /// <summary>
        /// Fills the row after <see cref="WriteChildren"/>. <paramref name="vtable"/> and <paramref name="place"/> are the positions of the vtable and the
        /// row, in bytes from the end of the frame.
        /// </summary>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public abstract void Fill(ref TRow row, int vtable, int place);

        /// <inheritdoc/>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public sealed override int Write(DraftWriter writer) => writer.Table(this);
    }
}
