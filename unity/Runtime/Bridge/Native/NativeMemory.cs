using System;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Native memory of the shim that FlatBuffers can read and write. Owned by one session; not thread-safe.</summary>
    internal abstract unsafe class NativeMemory : ByteBufferAllocator
    {
        private byte* address;

        public sealed override Span<byte> Span => new Span<byte>(address, Length);

        public sealed override ReadOnlySpan<byte> ReadOnlySpan => new ReadOnlySpan<byte>(address, Length);

        public sealed override Memory<byte> Memory => throw new NotSupportedException("native memory has no Memory<byte>");

        public sealed override ReadOnlyMemory<byte> ReadOnlyMemory => throw new NotSupportedException("native memory has no Memory<byte>");

        /// <summary>Makes this object refer to <paramref name="length"/> bytes from <paramref name="first"/> on; null and 0 for no memory.</summary>
        protected void Show(byte* first, int length)
        {
            address = first;
            Length = length;
        }
    }
}
