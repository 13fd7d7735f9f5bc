namespace Collektive.Bridge
{
    /// <summary>
    /// Staging object of one table. FlatBuffers wants children written before their table, and several sensors fill different
    /// fields of the same data, so the fields wait here. Reused every tick; not thread-safe.
    /// </summary>
    public abstract class Draft
    {
        /// <summary>Gives all fields the defaults of the schema; lists keep their capacity.</summary>
        public abstract void Clear();

        /// <summary>Path of the first field that is NaN or infinite, else null.</summary>
        public abstract string FindNotFinite();

        /// <summary>Writes the table, children first; its offset. Called by the buffers.</summary>
        public abstract int Write(DraftWriter writer);
    }
}
