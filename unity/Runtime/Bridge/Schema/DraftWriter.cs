using System;
using System.ComponentModel;
using System.Text;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Writes drafts and their children: strings, vectors and tables. The writer fills its own memory first and then copies it to the frame as one block,
    /// because a call of the builder for each part would cost more than the part itself. Like the builder's offsets, places are the distance in bytes from
    /// the end of the frame to the start of the data. The memory is reused every tick. Used by generated code.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class DraftWriter
    {
        /// <summary>The largest alignment of a field.</summary>
        private const int MaxAlignment = 8;

        private static readonly UTF8Encoding Strict = new UTF8Encoding(false, throwOnInvalidBytes: true);

        private FlatBufferBuilder builder;
        // This is filled backwards from its end, like the frame.
        private byte[] memory = new byte[1024];
        private int free;
        // Size of the frame when this block began.
        private int origin;
        private int[] offsets = new int[16];
        private int depth;
        // The vtables written to this frame. Tables with the same fields share a vtable.
        private VTablePlace[] vtables = new VTablePlace[8];
        private int vtableCount;

        internal DraftWriter()
        {
        }

        /// <summary>Index of the element that is being written; -1 for global data.</summary>
        internal int Element { private get; set; }

        /// <summary>Place of the most recently written data.</summary>
        private int Place => origin + memory.Length - free;

        /// <summary>Begins a block, which <see cref="End"/> copies to the frame.</summary>
        internal void Begin(FlatBufferBuilder frame)
        {
            builder = frame;
            builder.Prep(MaxAlignment, 0);
            origin = builder.Offset;
            free = memory.Length;
            Element = -1;
            depth = 0;
            vtableCount = 0;
        }

        internal unsafe void End()
        {
            var bytes = memory.Length - free;
            if (bytes == 0) return;
            builder.Prep(1, bytes);
            fixed (byte* first = &memory[free]) builder.Put<byte>((IntPtr)first, bytes);
        }

        /// <summary>Throws an exception if a required field is missing.</summary>
        public void Require(bool present, string field)
        {
            if (!present) throw Invalid(field + " is required by the schema and was not set");
        }

        /// <summary>Writes a string, and returns its place; 0 for null.</summary>
        public int String(string text)
        {
            if (text == null) return 0;
            var bytes = BytesOf(text);
            var at = Reserve(sizeof(int), sizeof(int) + bytes + 1);
            PutInt(at, bytes);
            Encoding.UTF8.GetBytes(text, 0, text.Length, memory, at + sizeof(int));
            memory[at + sizeof(int) + bytes] = 0;
            return Place;
        }

        /// <summary>Writes a vector of strings, and returns its place; 0 for an empty vector that is not required.</summary>
        public int Strings(DraftList<string> list, bool required, string field)
        {
            if (list.Count == 0 && !required) return 0;
            for (var i = 0; i < list.Count; i++)
            {
                if (list[i] == null) throw Invalid(field + "[" + i + "] is null; use an empty string instead");
                Push(String(list[i]));
            }
            return PopVector(list.Count);
        }

        /// <summary>Writes a vector of tables, and returns its place; 0 for an empty vector that is not required.</summary>
        public int Tables<T>(DraftTables<T> list, bool required) where T : Draft, new()
        {
            if (list.Count == 0 && !required) return 0;
            for (var i = 0; i < list.Count; i++) Push(list[i].Write(this));
            return PopVector(list.Count);
        }

        /// <summary>Writes a vector of scalars, enums or structs, and returns its place; 0 for an empty vector that is not required.</summary>
        public unsafe int Values<T>(DraftList<T> list, bool required, int alignment) where T : unmanaged
        {
            var count = list.Count;
            if (count == 0 && !required) return 0;
            var items = list.Items;
            var at = Reserve(Math.Max(alignment, sizeof(int)), count * sizeof(T));
            fixed (byte* all = memory)
            {
                var elements = (T*)(all + at);
                for (var i = 0; i < count; i++) elements[i] = items[i];
            }
            return Length(count);
        }

        internal unsafe int Table<TRow>(Draft<TRow> draft) where TRow : unmanaged
        {
            var vtable = VTable(draft.Layout, draft.WriteChildren(this));
            var at = Reserve(draft.Layout.Alignment, sizeof(TRow));
            fixed (byte* row = &memory[at])
            {
                *(TRow*)row = default;
                draft.Fill(ref *(TRow*)row, vtable, Place);
            }
            return Place;
        }

        /// <summary>Writes the first <paramref name="count"/> drafts, whose children have been written, as a vector of tables.</summary>
        internal unsafe int Rows<TDraft, TRow>(TDraft[] drafts, int[] vtables, int count) where TDraft : Draft<TRow> where TRow : unmanaged
        {
            var at = Reserve(drafts[0].Layout.Alignment, count * sizeof(TRow));
            Array.Clear(memory, at, count * sizeof(TRow));
            var first = Place;
            var place = first;
            fixed (byte* all = memory)
            {
                var rows = (TRow*)(all + at);
                for (var i = 0; i < count; i++)
                {
                    drafts[i].Fill(ref rows[i], vtables[i], place);
                    place -= sizeof(TRow);
                }
            }
            at = Reserve(sizeof(int), count * sizeof(int));
            // The tables have the order of the vector and the same size.
            var offset = Place - first;
            fixed (byte* all = memory)
            {
                var elements = (int*)(all + at);
                for (var i = 0; i < count; i++)
                {
                    elements[i] = offset;
                    offset += sizeof(TRow) - sizeof(int);
                }
            }
            return Length(count);
        }

        /// <summary>Returns the place of the vtable for rows without the slots in <paramref name="absent"/>. The vtable is written on first use.</summary>
        internal int VTable(RowLayout layout, ulong absent)
        {
            for (var i = vtableCount - 1; i >= 0; i--)
            {
                if (vtables[i].Absent == absent && ReferenceEquals(vtables[i].Layout, layout)) return vtables[i].Place;
            }
            if (vtableCount == vtables.Length) Array.Resize(ref vtables, 2 * vtableCount);
            var place = WriteVTable(layout, absent);
            vtables[vtableCount++] = new VTablePlace { Layout = layout, Absent = absent, Place = place };
            return place;
        }

        private unsafe int WriteVTable(RowLayout layout, ulong absent)
        {
            var slots = layout.Offsets;
            var bytes = (2 + slots.Length) * sizeof(ushort);
            var at = Reserve(sizeof(ushort), bytes);
            fixed (byte* all = memory)
            {
                var entries = (ushort*)(all + at);
                entries[0] = (ushort)bytes;
                entries[1] = (ushort)layout.Bytes;
                for (var slot = 0; slot < slots.Length; slot++) entries[2 + slot] = (absent >> slot & 1) == 0 ? slots[slot] : (ushort)0;
            }
            return Place;
        }

        private void Push(int offset)
        {
            if (depth == offsets.Length) Array.Resize(ref offsets, 2 * depth);
            offsets[depth++] = offset;
        }

        /// <summary>Pops <paramref name="count"/> offsets from the stack, and writes them as a vector in the order in which they were pushed.</summary>
        private int PopVector(int count)
        {
            var at = Reserve(sizeof(int), count * sizeof(int));
            depth -= count;
            for (var i = 0; i < count; i++) PutInt(at + i * sizeof(int), Place - i * sizeof(int) - offsets[depth + i]);
            return Length(count);
        }

        /// <summary>Ends a vector by writing its length in front of the elements.</summary>
        private int Length(int count)
        {
            PutInt(Reserve(sizeof(int), sizeof(int)), count);
            return Place;
        }

        /// <summary>Reserves aligned space in front of the bytes written so far, and returns the index of its first byte.</summary>
        private int Reserve(int alignment, int bytes)
        {
            var padding = -(Place + bytes) & (alignment - 1);
            if (free < padding + bytes) Grow(padding + bytes);
            for (; padding > 0; padding--) memory[--free] = 0;
            free -= bytes;
            return free;
        }

        private void Grow(int bytes)
        {
            var used = memory.Length - free;
            var larger = new byte[Math.Max(2 * memory.Length, checked(used + bytes))];
            Buffer.BlockCopy(memory, free, larger, larger.Length - used, used);
            free = larger.Length - used;
            memory = larger;
        }

        private unsafe void PutInt(int at, int value)
        {
            fixed (byte* place = &memory[at]) *(int*)place = value;
        }

        private int BytesOf(string text)
        {
            try
            {
                return Strict.GetByteCount(text);
            }
            catch (EncoderFallbackException)
            {
                throw Invalid("a text contains an unpaired surrogate");
            }
        }

        private BridgeException Invalid(string what)
        {
            var where = Element < 0 ? "the global data: " : "the sensor data of due node number " + Element + ": ";
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
