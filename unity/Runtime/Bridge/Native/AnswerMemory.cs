using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>The JVM's answer, read in place; valid until the session's next call.</summary>
    internal sealed unsafe class AnswerMemory : ByteBufferAllocator
    {
        private byte* address;

        public override Span<byte> Span => new Span<byte>(address, Length);

        public override ReadOnlySpan<byte> ReadOnlySpan => new ReadOnlySpan<byte>(address, Length);

        public override Memory<byte> Memory => throw new NotSupportedException("native memory has no Memory<byte>");

        public override ReadOnlyMemory<byte> ReadOnlyMemory => throw new NotSupportedException("native memory has no Memory<byte>");

        public override void GrowFront(int newSize) => throw new NotSupportedException("an answer is read-only");

        internal void Point(Shim.Answer answer)
        {
            address = answer.Address;
            Length = answer.Offset + answer.Length;
        }

        internal void Detach()
        {
            address = null;
            Length = 0;
        }
    }
}
