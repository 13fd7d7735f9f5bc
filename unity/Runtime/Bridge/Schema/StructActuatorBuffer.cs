using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>Actuator data that is a struct in the schema: elements are read straight from the frame's memory.</summary>
    public sealed class StructActuatorBuffer<T> : ActuatorBuffer<T> where T : unmanaged, IMirror
    {
        /// <inheritdoc/>
        public override T this[int index] => MemoryMarshal.Read<T>(frame.ToReadOnlySpan(ElementAt(index), ElementSize));

        private protected override unsafe int ElementSize => sizeof(T);
    }
}
