using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Writes drafts and their children: strings, vectors, tables. Offsets of children wait on a stack that is reused every tick.
    /// Used by generated code.
    /// </summary>
    public sealed class DraftWriter
    {
        private int[] offsets = new int[16];
        private int depth;
        // The vtables of this frame, which tables with the same fields share.
        private VTablePlace[] vtables = new VTablePlace[8];
        private int vtableCount;

        /// <summary>The builder that is written to.</summary>
        public FlatBufferBuilder Builder { get; private set; }

        /// <summary>Index of the element that is being written; -1 for global data.</summary>
        internal int Place { private get; set; }

        internal void Begin(FlatBufferBuilder builder)
        {
            Builder = builder;
            Place = -1;
            depth = 0;
            vtableCount = 0;
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

        internal unsafe int Table<TRow>(Draft<TRow> draft) where TRow : unmanaged
        {
            var vtable = VTable(draft.Layout, draft.WriteChildren(this));
            Builder.Prep(draft.Layout.Alignment, sizeof(TRow));
            var row = default(TRow);
            draft.Fill(ref row, vtable, Builder.Offset + sizeof(TRow));
            Builder.Put<byte>((IntPtr)(&row), sizeof(TRow));
            return Builder.Offset;
        }

        /// <summary>The vtable of rows without the slots in <paramref name="absent"/>, in bytes from the end of the frame; written at its first use.</summary>
        internal int VTable(RowLayout layout, ulong absent)
        {
            for (var i = vtableCount - 1; i >= 0; i--)
            {
                if (ReferenceEquals(vtables[i].Layout, layout) && vtables[i].Absent == absent) return vtables[i].Place;
            }
            if (vtableCount == vtables.Length) Array.Resize(ref vtables, 2 * vtableCount);
            var place = WriteVTable(layout, absent);
            vtables[vtableCount++] = new VTablePlace { Layout = layout, Absent = absent, Place = place };
            return place;
        }

        private int WriteVTable(RowLayout layout, ulong absent)
        {
            var offsets = layout.Offsets;
            var bytes = (2 + offsets.Length) * sizeof(ushort);
            Builder.Prep(sizeof(ushort), bytes);
            for (var slot = offsets.Length - 1; slot >= 0; slot--) Builder.PutUshort((absent >> slot & 1) == 0 ? offsets[slot] : (ushort)0);
            Builder.PutUshort((ushort)layout.Bytes);
            Builder.PutUshort((ushort)bytes);
            return Builder.Offset;
        }

        internal void Push(int offset)
        {
            if (depth == offsets.Length) Array.Resize(ref offsets, 2 * depth);
            offsets[depth++] = offset;
        }

        /// <summary>Writes the last offsets of the stack as a vector, in the order in which they were pushed.</summary>
        internal unsafe int PopVector(int count)
        {
            Builder.StartVector(sizeof(int), count, sizeof(int));
            if (count > 0)
            {
                depth -= count;
                var place = Builder.Offset + count * sizeof(int);
                for (var i = depth; i < depth + count; i++)
                {
                    offsets[i] = place - offsets[i];
                    place -= sizeof(int);
                }
                fixed (int* first = &offsets[depth]) Builder.Put<byte>((IntPtr)first, count * sizeof(int));
            }
            return Builder.EndVector().Value;
        }

        private BridgeException Missing(string what)
        {
            var where = Place < 0 ? "the global data: " : "the sensor data of due node number " + Place + ": ";
            return new BridgeException(BridgeError.Argument, where + what);
        }

        private struct VTablePlace
        {
            internal RowLayout Layout;
            internal ulong Absent;
            internal int Place;
        }
    }
}
