using System;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Reads the tables <c>Sensors</c> and <c>Actuators</c> of a frame, which have a single field, the vector <c>data</c>.</summary>
    internal static class FrameTable
    {
        private const int DataSlot = 0;
        private const int DataEntry = 4;

        internal static int Write(FlatBufferBuilder builder, int vector)
        {
            builder.StartTable(1);
            builder.AddOffset(DataSlot, vector, 0);
            return builder.EndTable();
        }

        /// <summary>Returns the position of the first element of <c>data</c>.</summary>
        internal static int FindData(ByteBuffer frame, int position, int elementSize, out int count)
        {
            try
            {
                var table = new Table(position, frame);
                var field = table.__offset(DataEntry);
                count = field == 0 ? 0 : table.__vector_len(field);
                if (count == 0) return 0;
                var first = table.__vector(field);
                frame.ToReadOnlySpan(first, checked(count * elementSize));
                return first;
            }
            catch (Exception e) when (e is ArgumentException || e is OverflowException || e is IndexOutOfRangeException)
            {
                throw new BridgeException(BridgeError.Frame, "the actuator data lies outside of its frame");
            }
        }
    }
}
