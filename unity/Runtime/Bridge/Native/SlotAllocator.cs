using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// A slot of the shim's pool as the memory of a <see cref="FlatBufferBuilder"/>: frames are built where the JVM reads them.
    /// Owned by one session; not thread-safe.
    /// </summary>
    internal sealed unsafe class SlotAllocator : NativeMemory
    {
        internal SlotAllocator(int capacity)
        {
            ShimLibrary.Check();
            ulong slot;
            var memory = new Shim.Memory { Size = (uint)sizeof(Shim.Memory) };
            Shim.Check(Shim.clk_slot_acquire(capacity, &slot, &memory));
            Slot = slot;
            Show(memory.Address, memory.Capacity);
        }

        /// <summary>The handle for the shim.</summary>
        internal ulong Slot { get; private set; }

        public override void GrowFront(int newSize)
        {
            var memory = new Shim.Memory { Size = (uint)sizeof(Shim.Memory) };
            Shim.Check(Shim.clk_slot_grow(Slot, newSize, Length, &memory));
            Show(memory.Address, memory.Capacity);
        }

        internal void Release()
        {
            if (Slot == 0) return;
            var slot = Slot;
            Slot = 0;
            Show(null, 0);
            Shim.Check(Shim.clk_slot_release(slot));
        }
    }
}
