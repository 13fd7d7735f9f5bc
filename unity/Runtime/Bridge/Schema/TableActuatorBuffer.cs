using System;
using System.ComponentModel;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Actuator data that is a table in the schema: elements are flatc's readers over the frame's memory. The previous ones are read from a copy of their
    /// frame, made in one block.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class TableActuatorBuffer<T> : ActuatorBuffer<T> where T : struct, IFlatbufferObject
    {
        private readonly TableShape shape;
        private ByteBuffer frame;
        private int first;
        private byte[] copied = Array.Empty<byte>();
        private ByteBuffer previous;
        private int previousFirst;

        /// <summary>Creates a reader of tables with that <paramref name="shape"/>.</summary>
        public TableActuatorBuffer(TableShape shape)
        {
            this.shape = shape;
        }

        /// <inheritdoc/>
        internal override T this[int index]
        {
            get
            {
                Require(index);
                return Reader(frame, Place(frame, first, index));
            }
        }

        /// <inheritdoc/>
        internal override T Previous(int index)
        {
            RequirePrevious(index);
            return Reader(previous, Place(previous, previousFirst, index));
        }

        /// <inheritdoc/>
        internal override void CopyPrevious(int index, ref AnswerCopy kept)
        {
            RequirePrevious(index);
            if (kept == null) kept = new TableAnswerCopy();
            ((TableAnswerCopy)kept).Take(shape, previous, Place(previous, previousFirst, index));
        }

        /// <inheritdoc/>
        internal override void Retain()
        {
            if (frame == null) return;
            var start = frame.Position;
            var length = frame.Length - start;
            if (length > copied.Length)
            {
                copied = new byte[Math.Max(length, 2 * copied.Length)];
                previous = new ByteBuffer(copied);
            }
            frame.ToSpan(start, length).CopyTo(copied);
            previousFirst = first - start;
            // Valid until the next frame, which may be long while a debugger stops the JVM.
            frame = previous;
            first = previousFirst;
        }

        private protected override int ElementSize => sizeof(int);

        private protected override void Show(ByteBuffer frame, int first, int elements)
        {
            this.frame = frame;
            this.first = first;
        }

        private int Place(ByteBuffer buffer, int vector, int index) => Table.__indirect(vector + index * ElementSize, buffer);

        private static T Reader(ByteBuffer buffer, int place)
        {
            var reader = default(T);
            reader.__init(place, buffer);
            return reader;
        }

        private sealed class TableAnswerCopy : AnswerCopy<T>
        {
            private readonly TableCopy copy = new TableCopy();
            private int place;

            public override T Value => Reader(copy.Buffer, place);

            internal void Take(TableShape shape, ByteBuffer from, int table)
            {
                copy.Clear();
                place = shape.Copy(from, table, copy);
            }
        }
    }
}
