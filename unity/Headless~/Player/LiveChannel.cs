using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.IO;
using System.Text;
using System.Threading;
using Mono.Unix;
using Mono.Unix.Native;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// The connection between a <see cref="LiveRun"/> and <c>./collektive live</c>. The process ends when the connection is closed.
    /// </summary>
    /// <remarks>
    /// Commands are lines of JSON. A message in the other direction consists of its length (a little-endian u32), the JSON of an event, and a zero. The event
    /// <c>frame</c> is followed by the bytes of the frame (FORMAT.md, Segment). If a frame has not been sent when the next one is ready, it is dropped,
    /// so the simulation never waits.
    /// </remarks>
    internal sealed class LiveChannel
    {
        private const int CloseOnExec = 1;

        private readonly BlockingCollection<string> commands = new BlockingCollection<string>();
        private readonly object gate = new object();
        private readonly Queue<byte[]> events = new Queue<byte[]>();
        private readonly UnixStream stream;
        private byte[] frame;
        private bool isWriting;

        internal LiveChannel(int descriptor)
        {
            Syscall.fcntl(descriptor, FcntlCommand.F_SETFD, CloseOnExec);
            stream = new UnixStream(descriptor);
            new Thread(ReadCommands) { IsBackground = true }.Start();
            new Thread(WriteMessages) { IsBackground = true }.Start();
        }

        /// <summary>Waits for a command and removes it from the queue; false if none has arrived in time.</summary>
        /// <param name="milliseconds">Maximum time to wait.</param>
        internal bool TryTake(int milliseconds, out string command) => commands.TryTake(out command, milliseconds);

        internal void Send(JObject message)
        {
            var bytes = Bytes(message, Array.Empty<byte>(), 0);
            lock (gate)
            {
                events.Enqueue(bytes);
                Monitor.PulseAll(gate);
            }
        }

        internal void SendFrame(JObject message, byte[] segment, int length)
        {
            var bytes = Bytes(message, segment, length);
            lock (gate)
            {
                frame = bytes;
                Monitor.PulseAll(gate);
            }
        }

        /// <summary>Waits until all messages have been sent.</summary>
        internal void Flush()
        {
            lock (gate)
            {
                while (events.Count > 0 || frame != null || isWriting) Monitor.Wait(gate);
            }
        }

        private static byte[] Bytes(JObject message, byte[] segment, int length)
        {
            var text = Encoding.UTF8.GetBytes(message.ToString(Formatting.None) + "\0");
            var bytes = new byte[4 + text.Length + length];
            for (var i = 0; i < 4; i++) bytes[i] = (byte)(bytes.Length - 4 >> 8 * i);
            text.CopyTo(bytes, 4);
            Buffer.BlockCopy(segment, 0, bytes, 4 + text.Length, length);
            return bytes;
        }

        private void ReadCommands()
        {
            try
            {
                var reader = new StreamReader(stream, Encoding.UTF8);
                for (string line; (line = reader.ReadLine()) != null;) commands.Add(line);
            }
            catch (UnixIOException)
            {
                // The connection was closed before all messages were received.
            }
            // The command has ended and closed the connection.
            Program.Exit(1);
        }

        private void WriteMessages()
        {
            try
            {
                while (true)
                {
                    byte[] next;
                    lock (gate)
                    {
                        isWriting = false;
                        Monitor.PulseAll(gate);
                        while (events.Count == 0 && frame == null) Monitor.Wait(gate);
                        isWriting = true;
                        if (events.Count > 0) next = events.Dequeue();
                        else (next, frame) = (frame, null);
                    }
                    stream.Write(next, 0, next.Length);
                }
            }
            catch (Exception error) when (error is IOException || error is UnixIOException)
            {
                Program.Exit(1);
            }
        }
    }
}
