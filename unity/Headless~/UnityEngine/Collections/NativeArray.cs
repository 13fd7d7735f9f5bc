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

    /// An array in managed memory. Copies share it, and none can be used after one of them is disposed. `NativeArrays` counts those not disposed.
    public struct NativeArray<T> : IDisposable where T : struct
    {
        Buffer buffer;
        readonly int start;
        readonly bool isPart;

        public NativeArray(int length, Allocator allocator, NativeArrayOptions options = NativeArrayOptions.ClearMemory)
        {
            if (allocator <= Allocator.None) throw new ArgumentException("Allocator must be Temp, TempJob or Persistent", nameof(allocator));
            buffer = new Buffer { Items = new T[length] };
            start = 0;
            isPart = false;
            Length = length;
            NativeArrays.Count++;
        }

        NativeArray(Buffer buffer, int start, int length)
        {
            this.buffer = buffer;
            this.start = start;
            isPart = true;
            Length = length;
        }

        public int Length { readonly get; private set; }
        public bool IsCreated => buffer != null;

        public T this[int index]
        {
            get => Items[Place(index)];
            set => Items[Place(index)] = value;
        }

        public readonly Span<T> AsSpan() => new Span<T>(Items, start, Length);

        public NativeArray<T> GetSubArray(int start, int length)
        {
            if (start < 0 || length < 0 || start > Length - length)
                throw new ArgumentOutOfRangeException(nameof(length), length, $"The sub-array exceeds the length of {Length}.");
            return new NativeArray<T>(buffer, this.start + start, length);
        }

        /// The memory that copies and parts share, as an identity.
        internal readonly object Memory => buffer;

        readonly T[] Items
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => buffer?.Items ?? ThrowDisposed();
        }

        // Mono does not inline methods that throw.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        readonly int Place(int index)
        {
            if ((uint)index >= (uint)Length) ThrowOutOfRange(index);
            return start + index;
        }

        readonly void ThrowOutOfRange(int index) => throw new IndexOutOfRangeException($"Index {index} is out of range of '{Length}' Length.");

        static T[] ThrowDisposed() => throw new ObjectDisposedException("The NativeArray has been deallocated, it is not allowed to access it");

        public void Dispose()
        {
            if (buffer == null) return;
            if (!isPart)
            {
                if (buffer.Items == null) throw new ObjectDisposedException("The NativeArray has already been disposed.");
                if (UnityEngine.QueryJobs.Uses(buffer))
                    throw new InvalidOperationException("A scheduled batch of queries uses the NativeArray. Call JobHandle.Complete before Dispose.");
                buffer.Items = null;
                NativeArrays.Count--;
            }
            buffer = null;
            Length = 0;
        }

        sealed class Buffer
        {
            internal T[] Items;
        }
    }
}
