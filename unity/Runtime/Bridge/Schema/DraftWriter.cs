using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Writes the children of drafts: strings, vectors, structs. Offsets of children wait on a stack that is reused every tick.
    /// Used by generated code.
    /// </summary>
    public sealed class DraftWriter
    {
        private int[] offsets = new int[16];
        private int depth;

        /// <summary>The builder that is written to.</summary>
        public FlatBufferBuilder Builder { get; private set; }

        /// <summary>Index of the element that is being written; -1 for global data.</summary>
        internal int Place { private get; set; }

        internal void Begin(FlatBufferBuilder builder)
        {
            Builder = builder;
            Place = -1;
            depth = 0;
        }

        /// <summary>Refuses data without a required field.</summary>
        public void Require(bool present, string field)
        {
            if (!present) throw Missing(field + " is required by the schema and was not set");
        }

        /// <summary>Writes a string; 0 for null.</summary>
        public int String(string text) => text == null ? 0 : Builder.CreateString(text).Value;

        /// <summary>Writes a vector of strings; 0 for an empty one that is not required.</summary>
        public int Strings(DraftList<string> list, bool required, string field)
        {
            if (list.Count == 0 && !required) return 0;
            for (var i = 0; i < list.Count; i++)
            {
                if (list[i] == null) throw Missing(field + "[" + i + "] is null; use an empty string instead");
                Push(Builder.CreateString(list[i]).Value);
            }
            return PopVector(list.Count);
        }

        /// <summary>Writes a vector of tables; 0 for an empty one that is not required.</summary>
        public int Tables<T>(DraftTables<T> list, bool required) where T : Draft, new()
        {
            if (list.Count == 0 && !required) return 0;
            for (var i = 0; i < list.Count; i++) Push(list[i].Write(this));
            return PopVector(list.Count);
        }

        /// <summary>
        /// Writes a vector of scalars, enums or structs by one block copy; 0 for an empty one that is not required. The
        /// alignment is the element's, in bytes.
        /// </summary>
        public int Values<T>(DraftList<T> list, bool required, int alignment) where T : unmanaged
        {
            if (list.Count == 0 && !required) return 0;
            return Blit.Vector(Builder, list.Items, list.Count, alignment);
        }

        /// <summary>Adds a struct to the open table; null is absent.</summary>
        public void Struct<T>(int slot, T? value, int alignment) where T : unmanaged
        {
            if (value.HasValue) Builder.AddStruct(slot, Blit.Inline(Builder, value.GetValueOrDefault(), alignment), 0);
        }

        internal void Push(int offset)
        {
            if (depth == offsets.Length) Array.Resize(ref offsets, 2 * depth);
            offsets[depth++] = offset;
        }

        /// <summary>Writes the last offsets of the stack as a vector, in the order in which they were pushed.</summary>
        internal int PopVector(int count)
        {
            Builder.StartVector(sizeof(int), count, sizeof(int));
            for (var i = 0; i < count; i++) Builder.AddOffset(offsets[--depth]);
            return Builder.EndVector().Value;
        }

        private BridgeException Missing(string what)
        {
            var where = Place < 0 ? "the global data: " : "the sensor data of due node number " + Place + ": ";
            return new BridgeException(BridgeError.Argument, where + what);
        }
    }
}
