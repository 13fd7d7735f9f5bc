using System;
using Google.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// A slot of the shim's pool as the memory of a <see cref="FlatBufferBuilder"/>: frames are built where the JVM reads them.
    /// Owned by one session; not thread-safe.
    /// </summary>
    internal sealed unsafe class SlotAllocator : ByteBufferAllocator
    {
        private byte* address;

        internal SlotAllocator(int capacity)
        {
            ulong slot;
            var memory = new Shim.Memory { Size = (uint)sizeof(Shim.Memory) };
            Shim.Check(Shim.clk_slot_acquire(capacity, &slot, &memory));
            Slot = slot;
            Adopt(memory);
        }

        /// <summary>The handle to hand to the shim.</summary>
        internal ulong Slot { get; private set; }

        public override Span<byte> Span => new Span<byte>(address, Length);

        public override ReadOnlySpan<byte> ReadOnlySpan => new ReadOnlySpan<byte>(address, Length);

        public override Memory<byte> Memory => throw new NotSupportedException("native memory has no Memory<byte>");

        public override ReadOnlyMemory<byte> ReadOnlyMemory => throw new NotSupportedException("native memory has no Memory<byte>");

        public override void GrowFront(int newSize)
        {
            var memory = new Shim.Memory { Size = (uint)sizeof(Shim.Memory) };
            Shim.Check(Shim.clk_slot_grow(Slot, newSize, Length, &memory));
            Adopt(memory);
        }

        internal void Release()
        {
            if (Slot == 0) return;
            var slot = Slot;
            Slot = 0;
            address = null;
            Length = 0;
            Shim.Check(Shim.clk_slot_release(slot));
        }

        private void Adopt(Shim.Memory memory)
        {
            address = memory.Address;
            Length = memory.Capacity;
        }
    }
}
