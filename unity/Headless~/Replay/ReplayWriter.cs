using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.IO.Compression;
using System.Text;

namespace Collektive.Headless
{
    /// <summary>
    /// Writes a run as a replay page; the format is in FORMAT.md. For each frame: <see cref="BeginFrame"/>, each node, then each
    /// link between those nodes, <see cref="EndFrame"/>; at the end <see cref="Finish"/>. Frames go to a scratch file as they come:
    /// memory does not grow with their number, and a frame allocates nothing once the greatest numbers of nodes and links were seen.
    /// One thread at a time. After an exception the recording is of no further use: dispose the writer.
    /// </summary>
    public sealed class ReplayWriter : IDisposable
    {
        internal const string Placeholder = "@@REPLAY@@";
        internal const int Version = 1;

        private const int MaxSlots = 1 << 26;
        private const int NoScalar = 65535;

        private readonly string scratchPath;
        private readonly Stream recording;
        private readonly MemoryStream frame = new MemoryStream();
        private readonly BinaryWriter writer;

        private readonly Dictionary<int, int> slotOfId = new Dictionary<int, int>();
        private int slots;
        private int slotsBefore;
        private int[] idOfSlot = new int[64];
        private int[] lastFrameOfSlot = new int[64];
        private float[] x = new float[64];
        private float[] y = new float[64];
        private float[] z = new float[64];
        private float[] scalar = new float[64];

        private long[] links = new long[256];
        private long[] linksBefore = new long[256];
        private long[] removed = new long[256];
        private long[] added = new long[256];
        private int linkCount;
        private int linkCountBefore;

        private int frames;
        private bool inFrame;
        private bool finished;
        private double lastTime = double.NegativeInfinity;

        /// <param name="scratchPath">A file for the frames until <see cref="Finish"/>: made or replaced now, deleted by <see cref="Dispose"/>.</param>
        /// <param name="metadata">What the page shows beside the frames.</param>
        public ReplayWriter(string scratchPath, ReplayMetadata metadata)
        {
            var json = Encoding.UTF8.GetBytes(metadata.ToJson());
            this.scratchPath = scratchPath;
            recording = new GZipStream(new FileStream(scratchPath, FileMode.Create, FileAccess.Write), CompressionLevel.Optimal);
            writer = new BinaryWriter(frame);
            writer.Write(Encoding.ASCII.GetBytes("CLKR"));
            writer.Write(Version);
            writer.Write(json.Length);
            writer.Write(json);
            FlushBuffer();
        }

        /// <summary>Number of frames written.</summary>
        public int Frames => frames;

        /// <param name="time">Simulated seconds; later than the frame before.</param>
        public void BeginFrame(double time)
        {
            if (inFrame || finished) throw Order(nameof(BeginFrame), inFrame ? "the frame before is not ended" : "the replay is finished");
            if (!(time > lastTime) || double.IsInfinity(time))
                throw new ArgumentException("Frame " + Number(frames) + " of the replay has time " + Number(time) + ": it must be finite and later than "
                    + Number(lastTime) + ".", nameof(time));
            lastTime = time;
            frames++;
            inFrame = true;
            slotsBefore = slots;
            linkCount = 0;
        }

        /// <summary>A node that exists in this frame, once.</summary>
        /// <param name="id">The node's id, the same in all frames.</param>
        /// <param name="scalar">The value for its colour; NaN: it has none.</param>
        public void Node(int id, float x, float y, float z, float scalar)
        {
            if (!inFrame) throw Order(nameof(Node), "no frame has begun");
            if (!IsFinite(x) || !IsFinite(y) || !IsFinite(z))
                throw new ArgumentException("Node " + Number(id) + " is at (" + Number(x) + ", " + Number(y) + ", " + Number(z) + ") in frame "
                    + Number(frames - 1) + " of the replay: positions must be finite.");
            if (float.IsInfinity(scalar))
                throw new ArgumentException("Node " + Number(id) + " has an infinite scalar in frame " + Number(frames - 1)
                    + " of the replay: give a finite one, or NaN for none.");
            if (!slotOfId.TryGetValue(id, out var slot)) slot = NewSlot(id);
            else if (lastFrameOfSlot[slot] == frames)
                throw new ArgumentException("Node " + Number(id) + " is given twice in frame " + Number(frames - 1) + " of the replay: give each node once.");
            lastFrameOfSlot[slot] = frames;
            this.x[slot] = x;
            this.y[slot] = y;
            this.z[slot] = z;
            this.scalar[slot] = scalar;
        }

        /// <summary>A link between two different nodes of this frame. Directions and repetitions make no difference: the page draws one line.</summary>
        public void Link(int a, int b)
        {
            if (!inFrame) throw Order(nameof(Link), "no frame has begun");
            int slotA = PresentSlot(a, a, b), slotB = PresentSlot(b, a, b);
            if (slotA == slotB)
                throw new ArgumentException("Node " + Number(a) + " is linked to itself in frame " + Number(frames - 1)
                    + " of the replay: leave that link out.");
            if (linkCount == links.Length) Array.Resize(ref links, linkCount * 2);
            links[linkCount++] = slotA < slotB ? Key(slotA, slotB) : Key(slotB, slotA);
        }

        public void EndFrame()
        {
            if (!inFrame) throw Order(nameof(EndFrame), "no frame has begun");
            inFrame = false;
            writer.Write(0); // the length, known below
            writer.Write(lastTime);
            writer.Write(slots - slotsBefore);
            for (var slot = slotsBefore; slot < slots; slot++) writer.Write(idOfSlot[slot]);
            WriteNodes();
            WriteLinks();
            var length = (int)frame.Length - sizeof(int);
            frame.Position = 0;
            writer.Write(length);
            FlushBuffer();
        }

        /// <summary>Writes the page: the template with the recording in it. Call it once, after the last frame.</summary>
        /// <param name="templatePath">The page that <c>build.mjs</c> makes.</param>
        /// <param name="outputHtmlPath">Made or replaced.</param>
        /// <exception cref="InvalidDataException">The template is not one; nothing is written.</exception>
        public void Finish(string templatePath, string outputHtmlPath)
        {
            if (inFrame || finished) throw Order(nameof(Finish), inFrame ? "the last frame is not ended" : "the replay is finished");
            if (frames == 0) throw Order(nameof(Finish), "there is no frame");
            var template = File.ReadAllText(templatePath);
            var start = template.IndexOf(Placeholder, StringComparison.Ordinal);
            if (start < 0 || template.IndexOf(Placeholder, start + 1, StringComparison.Ordinal) >= 0)
                throw new InvalidDataException(templatePath + " is not a replay template (it must hold " + Placeholder + " once): build it with build.mjs.");
            finished = true;
            writer.Write(0);
            FlushBuffer();
            recording.Dispose();
            WholeFile.Write(outputHtmlPath, page =>
            {
                page.Write(template.Substring(0, start));
                WriteBase64(page);
                page.Write(template.Substring(start + Placeholder.Length));
            });
        }

        /// <summary>Closes and deletes the scratch file; the finished page stays.</summary>
        public void Dispose()
        {
            finished = true;
            recording.Dispose();
            File.Delete(scratchPath);
        }

        private int NewSlot(int id)
        {
            if (slots == MaxSlots)
                throw new InvalidOperationException("The replay has " + Number(MaxSlots) + " different node ids, the most that it can hold.");
            if (slots == idOfSlot.Length)
            {
                Array.Resize(ref idOfSlot, slots * 2);
                Array.Resize(ref lastFrameOfSlot, slots * 2);
                Array.Resize(ref x, slots * 2);
                Array.Resize(ref y, slots * 2);
                Array.Resize(ref z, slots * 2);
                Array.Resize(ref scalar, slots * 2);
            }
            slotOfId.Add(id, slots);
            idOfSlot[slots] = id;
            return slots++;
        }

        private int PresentSlot(int id, int a, int b)
        {
            if (slotOfId.TryGetValue(id, out var slot) && lastFrameOfSlot[slot] == frames) return slot;
            throw new ArgumentException("Link " + Number(a) + " - " + Number(b) + ": node " + Number(id) + " is not in frame " + Number(frames - 1)
                + " of the replay. Give a frame's nodes before its links.");
        }

        private void WriteNodes()
        {
            for (var first = 0; first < slots; first += 8)
            {
                var bits = 0;
                for (var slot = first; slot < slots && slot < first + 8; slot++)
                    if (lastFrameOfSlot[slot] == frames) bits |= 1 << (slot - first);
                writer.Write((byte)bits);
            }
            Range(x, out var minX, out var maxX);
            Range(y, out var minY, out var maxY);
            Range(z, out var minZ, out var maxZ);
            Range(scalar, out var minScalar, out var maxScalar);
            writer.Write(minX);
            writer.Write(minY);
            writer.Write(minZ);
            writer.Write(minScalar);
            writer.Write(maxX);
            writer.Write(maxY);
            writer.Write(maxZ);
            writer.Write(maxScalar);
            WriteQuantised(x, minX, maxX, 65535);
            WriteQuantised(y, minY, maxY, 65535);
            WriteQuantised(z, minZ, maxZ, 65535);
            WriteQuantised(scalar, minScalar, maxScalar, 65534);
        }

        private void Range(float[] values, out float min, out float max)
        {
            min = float.PositiveInfinity;
            max = float.NegativeInfinity;
            for (var slot = 0; slot < slots; slot++)
            {
                if (lastFrameOfSlot[slot] != frames || float.IsNaN(values[slot])) continue;
                min = Math.Min(min, values[slot]);
                max = Math.Max(max, values[slot]);
            }
            if (min > max) min = max = 0;
        }

        private void WriteQuantised(float[] values, float min, float max, int steps)
        {
            // In double: the extent of two floats may be no float.
            var scale = max > min ? steps / ((double)max - min) : 0;
            for (var slot = 0; slot < slots; slot++)
            {
                if (lastFrameOfSlot[slot] != frames) continue;
                var value = values[slot];
                writer.Write((ushort)(float.IsNaN(value) ? NoScalar : (int)(((double)value - min) * scale + 0.5)));
            }
        }

        private void WriteLinks()
        {
            Array.Sort(links, 0, linkCount);
            var distinct = 0;
            for (var i = 0; i < linkCount; i++)
                if (i == 0 || links[i] != links[i - 1]) links[distinct++] = links[i];
            linkCount = distinct;

            if (removed.Length < linkCountBefore) removed = new long[linksBefore.Length];
            if (added.Length < linkCount) added = new long[links.Length];
            int old = 0, current = 0, removedCount = 0, addedCount = 0;
            while (old < linkCountBefore || current < linkCount)
            {
                if (current == linkCount || (old < linkCountBefore && linksBefore[old] < links[current])) removed[removedCount++] = linksBefore[old++];
                else if (old == linkCountBefore || links[current] < linksBefore[old]) added[addedCount++] = links[current++];
                else
                {
                    old++;
                    current++;
                }
            }
            WritePairs(removed, removedCount);
            WritePairs(added, addedCount);

            var swap = linksBefore;
            linksBefore = links;
            linkCountBefore = linkCount;
            links = swap;
        }

        private void WritePairs(long[] keys, int count)
        {
            writer.Write(count);
            int a = -1, b = 0;
            for (var i = 0; i < count; i++)
            {
                int nextA = (int)(keys[i] >> 32), nextB = (int)keys[i];
                WriteVarint(nextA - a);
                WriteVarint(nextB - (nextA == a ? b : nextA));
                a = nextA;
                b = nextB;
            }
        }

        private void WriteVarint(int value)
        {
            for (; value >= 0x80; value >>= 7) writer.Write((byte)(value | 0x80));
            writer.Write((byte)value);
        }

        private void FlushBuffer()
        {
            recording.Write(frame.GetBuffer(), 0, (int)frame.Length);
            frame.SetLength(0);
        }

        private void WriteBase64(TextWriter page)
        {
            var bytes = new byte[3 << 16]; // whole groups of three bytes, so that the pieces join
            using (var scratch = File.OpenRead(scratchPath))
            {
                int filled;
                do
                {
                    filled = 0;
                    for (int read; filled < bytes.Length && (read = scratch.Read(bytes, filled, bytes.Length - filled)) > 0;) filled += read;
                    page.Write(Convert.ToBase64String(bytes, 0, filled));
                }
                while (filled == bytes.Length);
            }
        }

        private static long Key(int a, int b) => (long)a << 32 | (uint)b;

        private static bool IsFinite(float value) => !float.IsNaN(value) && !float.IsInfinity(value);

        private static string Number(double value) => value.ToString("R", CultureInfo.InvariantCulture);

        private static InvalidOperationException Order(string call, string why) =>
            new InvalidOperationException("ReplayWriter." + call + ": " + why
                + ". The order is BeginFrame, Node..., Link..., EndFrame for each frame, then Finish.");
    }
}
