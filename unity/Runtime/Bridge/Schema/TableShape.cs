using System;
using System.Collections.Generic;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Lists the fields of a table that are stored outside of the table, so that tables can be copied. Generated code adds the fields once. A slot is the
    /// index of a field in the table's declaration. Deprecated fields are not copied.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class TableShape
    {
        private const int FirstEntry = 2 * sizeof(ushort);

        private readonly List<Child> children = new List<Child>();

        /// <summary>Adds a string.</summary>
        public TableShape Text(int slot) => Add(new Child(slot, Kind.Text, 0, null));

        /// <summary>Adds a vector of strings.</summary>
        public TableShape Texts(int slot) => Add(new Child(slot, Kind.Texts, 0, null));

        /// <summary>Adds a vector of numbers or structs of the given size in bytes.</summary>
        public TableShape Values(int slot, int elementBytes) => Add(new Child(slot, Kind.Values, elementBytes, null));

        /// <summary>Adds a table.</summary>
        public TableShape Table(int slot, TableShape shape) => Add(new Child(slot, Kind.Table, 0, shape));

        /// <summary>Adds a vector of tables.</summary>
        public TableShape Tables(int slot, TableShape shape) => Add(new Child(slot, Kind.Tables, 0, shape));

        private enum Kind
        {
            Text,
            Texts,
            Values,
            Table,
            Tables,
        }

        /// <summary>Copies the table at <paramref name="table"/> with its children, and returns its position in the copy.</summary>
        internal int Copy(ByteBuffer from, int table, TableCopy to)
        {
            var vtable = table - from.GetInt(table);
            var entries = from.GetUshort(vtable);
            var vtableCopy = to.Add(from, vtable, entries);
            var copy = to.Add(from, table, from.GetUshort(vtable + sizeof(ushort)));
            to.Buffer.PutInt(copy, copy - vtableCopy);
            for (var i = 0; i < children.Count; i++)
            {
                var entry = FirstEntry + children[i].Slot * sizeof(ushort);
                var offset = entry < entries ? from.GetUshort(vtable + entry) : 0;
                if (offset != 0) Point(to, copy + offset, Copy(children[i], from, Indirect(from, table + offset), to));
            }
            return copy;
        }

        private TableShape Add(Child child)
        {
            children.Add(child);
            return this;
        }

        private static int Copy(Child child, ByteBuffer from, int place, TableCopy to)
        {
            switch (child.Kind)
            {
                case Kind.Table: return child.Shape.Copy(from, place, to);
                case Kind.Text: return CopyText(from, place, to);
                case Kind.Values: return CopyVector(from, place, child.ElementBytes, to);
            }
            var copy = CopyVector(from, place, sizeof(int), to);
            var count = from.GetInt(place);
            for (var i = 1; i <= count; i++)
            {
                var element = Indirect(from, place + i * sizeof(int));
                Point(to, copy + i * sizeof(int), child.Kind == Kind.Texts ? CopyText(from, element, to) : child.Shape.Copy(from, element, to));
            }
            return copy;
        }

        /// <summary>Copies a string with its terminating zero.</summary>
        private static int CopyText(ByteBuffer from, int place, TableCopy to) => to.Add(from, place, checked(sizeof(int) + from.GetInt(place) + 1));

        private static int CopyVector(ByteBuffer from, int place, int elementBytes, TableCopy to) =>
            to.Add(from, place, checked(sizeof(int) + from.GetInt(place) * elementBytes));

        private static int Indirect(ByteBuffer from, int place) => place + from.GetInt(place);

        private static void Point(TableCopy to, int field, int target) => to.Buffer.PutInt(field, target - field);

        private readonly struct Child
        {
            internal readonly int Slot;
            internal readonly Kind Kind;
            internal readonly int ElementBytes;
            internal readonly TableShape Shape;

            internal Child(int slot, Kind kind, int elementBytes, TableShape shape)
            {
                Slot = slot;
                Kind = kind;
                ElementBytes = elementBytes;
                Shape = shape;
            }
        }
    }
}
