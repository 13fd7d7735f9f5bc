using System;
using Collektive.FlatBuffers;

namespace Collektive.Bridge
{
    /// <summary>Copies mirrors and scalars into a frame as blocks of memory, because both have the layout of the schema.</summary>
    internal static class Blit
    {
        internal static unsafe int Vector<T>(FlatBufferBuilder builder, T[] items, int count, int alignment) where T : unmanaged
        {
            builder.StartVector(sizeof(T), count, alignment);
            if (count > 0)
            {
                if (count > items.Length) throw new ArgumentOutOfRangeException(nameof(count));
                fixed (T* first = items) builder.Put<byte>((IntPtr)first, count * sizeof(T));
            }
            return builder.EndVector().Value;
        }
    }
}
