using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Actuator data that is a table in the schema: elements are flatc's readers over the frame's memory.</summary>
    public sealed class TableActuatorBuffer<T> : ActuatorBuffer<T> where T : struct, IFlatbufferObject
    {
        private ByteBuffer frame;
        private int first;

        /// <inheritdoc/>
        public override T this[int index]
        {
            get
            {
                Require(index);
                var reader = default(T);
                reader.__init(Table.__indirect(first + index * ElementSize, frame), frame);
                return reader;
            }
        }

        private protected override int ElementSize => sizeof(int);

        private protected override void Show(ByteBuffer frame, int first, int elements)
        {
            this.frame = frame;
            this.first = first;
        }
    }
}
