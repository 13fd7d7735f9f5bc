using System;
using System.Runtime.CompilerServices;
using UnityEngine.Headless;

namespace Unity.Collections
{
    public enum Allocator
    {
        Invalid = 0,
        None = 1,
        Temp = 2,
        TempJob = 3,
        Persistent = 4,
        AudioKernel = 5,
        Domain = 6,
        FirstUserIndex = 64,
    }

    public enum NativeArrayOptions
    {
        UninitializedMemory = 0,
        ClearMemory = 1,
    }

    /// An array in managed memory. `NativeArrays` counts the arrays that were not disposed.
    public struct NativeArray<T> : IDisposable where T : struct
    {
        T[] items;
        readonly int start;

        public NativeArray(int length, Allocator allocator, NativeArrayOptions options = NativeArrayOptions.ClearMemory)
        {
            if (allocator <= Allocator.None) throw new ArgumentException("Allocator must be Temp, TempJob or Persistent", nameof(allocator));
            items = new T[length];
            start = 0;
            Length = length;
            NativeArrays.Count++;
        }

        NativeArray(T[] items, int start, int length)
        {
            this.items = items;
            this.start = start;
            Length = length;
        }

        public int Length { readonly get; private set; }
        public bool IsCreated => items != null;

        public T this[int index]
        {
            get => items[Place(index)];
            set => items[Place(index)] = value;
        }

        public readonly Span<T> AsSpan() => new Span<T>(items, start, Length);

        public NativeArray<T> GetSubArray(int start, int length)
        {
            if (start < 0 || length < 0 || start > Length - length)
                throw new ArgumentOutOfRangeException(nameof(length), length, $"The sub-array exceeds the length of {Length}.");
            return new NativeArray<T>(items, this.start + start, length);
        }

        // Mono does not inline methods that throw.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        readonly int Place(int index)
        {
            if ((uint)index >= (uint)Length) ThrowOutOfRange(index);
            return start + index;
        }

        readonly void ThrowOutOfRange(int index) => throw new IndexOutOfRangeException($"Index {index} is out of range of '{Length}' Length.");

        public void Dispose()
        {
            if (items == null) throw new ObjectDisposedException("The NativeArray has already been disposed.");
            items = null;
            Length = 0;
            NativeArrays.Count--;
        }
    }
}
