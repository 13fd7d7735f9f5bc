using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>
    /// Lets a <see cref="FlatBufferBuilder"/> build frames in a slot of the shim's pool, from which the JVM reads them without a copy. Owned by one
    /// session; not thread-safe.
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

        /// <summary>The shim's handle of the slot.</summary>
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
