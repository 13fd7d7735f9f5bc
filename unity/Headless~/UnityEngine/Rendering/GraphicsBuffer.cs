using System;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    /// Simulates a buffer on the graphics card. Tests read its content with `Data`.
    public sealed class GraphicsBuffer : IDisposable
    {
        [Flags]
        public enum Target
        {
            Vertex = 1 << 0,
            Index = 1 << 1,
            CopySource = 1 << 2,
            CopyDestination = 1 << 3,
            Structured = 1 << 4,
            Raw = 1 << 5,
            Append = 1 << 6,
            Counter = 1 << 7,
            IndirectArguments = 1 << 8,
            Constant = 1 << 9,
        }

        const Target NeedsCompute = Target.Structured | Target.Raw | Target.Append | Target.Counter | Target.IndirectArguments;

        readonly byte[] memory;
        bool released;

        public GraphicsBuffer(Target target, int count, int stride)
        {
            if ((target & NeedsCompute) != 0 && !SystemInfo.supportsComputeShaders)
                throw new ArgumentException("This device does not support compute shaders, which buffers of target " + target + " require.", nameof(target));
            if (count <= 0) throw new ArgumentException("A buffer must hold at least one element.", nameof(count));
            if (stride <= 0 || stride % 4 != 0) throw new ArgumentException("A buffer's stride must be a multiple of 4.", nameof(stride));
            this.target = target;
            this.count = count;
            this.stride = stride;
            memory = new byte[count * stride];
            Headless.DrawLog.Buffers++;
        }

        public Target target { get; }
        public int count { get; }
        public int stride { get; }

        /// Returns the elements in the form that a shader reads.
        internal T[] Data<T>()
            where T : struct => MemoryMarshal.Cast<byte, T>(memory).ToArray();

        public bool IsValid() => !released;

        public void SetData(Array data) => SetData(data, 0, 0, data.Length);

        public void SetData(Array data, int managedBufferStartIndex, int graphicsBufferStartIndex, int count)
        {
            if (released) throw new NullReferenceException("The buffer has been released.");
            var pinned = GCHandle.Alloc(data, GCHandleType.Pinned);
            try
            {
                var element = Marshal.SizeOf(data.GetType().GetElementType());
                if (managedBufferStartIndex < 0 || count < 0 || managedBufferStartIndex + count > data.Length
                    || graphicsBufferStartIndex < 0 || graphicsBufferStartIndex * stride + count * element > memory.Length)
                    throw new ArgumentOutOfRangeException(nameof(count), count, "Bad indices for SetData: they exceed the data or the buffer.");
                Marshal.Copy(pinned.AddrOfPinnedObject() + managedBufferStartIndex * element, memory, graphicsBufferStartIndex * stride, count * element);
            }
            finally
            {
                pinned.Free();
            }
        }

        public void Release() => Dispose();

        public void Dispose()
        {
            if (released) return;
            released = true;
            Headless.DrawLog.Buffers--;
        }
    }
}
