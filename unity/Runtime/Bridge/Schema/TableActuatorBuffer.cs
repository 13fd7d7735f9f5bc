using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Actuator data that is a table in the schema: elements are flatc's readers over the frame's memory.</summary>
    public sealed class TableActuatorBuffer<T> : ActuatorBuffer<T> where T : struct, IFlatbufferObject
    {
        /// <inheritdoc/>
        public override T this[int index]
        {
            get
            {
                var reader = default(T);
                reader.__init(Table.__indirect(ElementAt(index), frame), frame);
                return reader;
            }
        }

        private protected override int ElementSize => sizeof(int);
    }
}
