using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Net;
using System.Net.Sockets;
using System.Runtime.InteropServices;
using Collektive.FlatBuffers;

namespace Collektive.Headless.Bench
{
    /// <summary>The second process (org.collektive.bench.tick.ServerKt) and the socket to it. Sending and receiving allocate nothing.</summary>
    internal sealed unsafe class Peer : IDisposable
    {
        private const int RequestHeader = 3 * sizeof(int);
        private const int AnswerHeader = 2 * sizeof(int);

        private readonly Process process;
        private readonly Socket socket;
        private readonly int descriptor;
        private int lastId;
        private readonly PinnedMemory received = new PinnedMemory(1 << 16);

        internal Peer(BenchSettings settings)
        {
            var start = new ProcessStartInfo(Path.Combine(settings.JavaHome, "bin", "java"))
            {
                Arguments = string.Join(" ", BenchSettings.JvmOptions) + " -cp \"" + settings.HostJar + ":" + settings.LibraryJar + ":" +
                    string.Join(":", settings.Jars) +
                    "\" org.collektive.bench.tick.ServerKt",
                RedirectStandardOutput = true,
                UseShellExecute = false,
            };
            process = Process.Start(start);
            var port = process.StandardOutput.ReadLine();
            if (port == null) throw new BenchException("the second process did not start: its message is above");
            socket = new Socket(AddressFamily.InterNetwork, SocketType.Stream, ProtocolType.Tcp) { NoDelay = true };
            socket.Connect(IPAddress.Loopback, int.Parse(port, CultureInfo.InvariantCulture));
            descriptor = (int)socket.Handle;
        }

        /// <summary>The last answer's payload; valid until the next call.</summary>
        internal ByteBuffer Answer => received.Buffer;

        /// <summary>Number of a session or workload of the second process.</summary>
        internal int NewId() => ++lastId;

        /// <summary>Sends the frame that a builder finished, in one write, and waits for the answer.</summary>
        internal void Call(PeerRequest kind, int id, FlatBufferBuilder builder)
        {
            var length = builder.DataBuffer.Length - builder.DataBuffer.Position;
            builder.AddInt(length);
            builder.AddInt(id);
            builder.AddInt((int)kind);
            var frame = builder.DataBuffer;
            fixed (byte* first = frame.ToSpan(frame.Length - builder.Offset, RequestHeader + length)) Call(first, RequestHeader + length);
        }

        internal void Call(PeerRequest kind, int id, int first = 0, int second = 0)
        {
            var words = stackalloc int[] { (int)kind, id, 2 * sizeof(int), first, second };
            Call((byte*)words, RequestHeader + 2 * sizeof(int));
        }

        internal long Number(int index) => Answer.GetLong(Answer.Position + index * sizeof(long));

        private void Call(byte* bytes, int length)
        {
            for (var done = 0; done < length;)
            {
                var sent = (int)send(descriptor, bytes + done, (IntPtr)(length - done), 0);
                if (sent <= 0) throw new BenchException("the second process no longer listens");
                done += sent;
            }
            var have = 0;
            var want = AnswerHeader;
            while (have < want)
            {
                var count = (int)recv(descriptor, received.Address + have, (IntPtr)(received.Length - have), 0);
                if (count <= 0) throw new BenchException("the second process ended: its message is above");
                have += count;
                if (have < AnswerHeader) continue;
                want = AnswerHeader + ((int*)received.Address)[1];
                if (want > received.Length) received.Grow(2 * want, have);
            }
            var status = *(int*)received.Address;
            if (status != 0) throw new BenchException("the second process answered " + status + ": its message is above");
            received.Buffer.Position = AnswerHeader;
        }

        public void Dispose()
        {
            socket.Dispose();
            if (!process.WaitForExit(5000)) process.Kill();
            process.Dispose();
            received.Dispose();
        }

        [DllImport("libc")]
        private static extern IntPtr send(int socket, byte* bytes, IntPtr length, int flags);

        [DllImport("libc")]
        private static extern IntPtr recv(int socket, byte* bytes, IntPtr length, int flags);

        /// <summary>Memory that both the system and FlatBuffers can reach.</summary>
        private sealed class PinnedMemory : IDisposable
        {
            private GCHandle pin;

            internal PinnedMemory(int length) => Pin(new byte[length]);

            internal byte* Address { get; private set; }

            internal int Length { get; private set; }

            internal ByteBuffer Buffer { get; private set; }

            internal void Grow(int length, int keep)
            {
                var larger = new byte[length];
                Marshal.Copy((IntPtr)Address, larger, 0, keep);
                pin.Free();
                Pin(larger);
            }

            public void Dispose() => pin.Free();

            private void Pin(byte[] bytes)
            {
                pin = GCHandle.Alloc(bytes, GCHandleType.Pinned);
                Address = (byte*)pin.AddrOfPinnedObject();
                Length = bytes.Length;
                Buffer = new ByteBuffer(bytes);
            }
        }
    }

    /// <summary>Requests to the second process, with the numbers of <c>Server.kt</c>.</summary>
    internal enum PeerRequest
    {
        Open = 1,
        Step = 2,
        Close = 3,
        Engine = 4,
        Loops = 5,
        Run = 6,
        Report = 7,
    }
}
