using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.IO.Compression;
using System.Text;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// Writes a run as a replay page in the format of FORMAT.md. For each frame, call <see cref="BeginFrame"/>, add all nodes and then all links, and call
    /// <see cref="EndFrame"/>. Call <see cref="Finish"/> at the end. After every <see cref="FramesPerSegment"/> frames, the frames are written to a scratch
    /// file, and slots of departed nodes are reused. Memory therefore grows by only eight bytes per frame. Frames allocate only at the end of a segment, or
    /// if they have more nodes or links than any earlier frame. Not thread-safe. After an exception, the recording is unusable and the writer must be
    /// disposed of.
    /// </summary>
    public sealed class ReplayWriter : IDisposable
    {
        /// <summary>Number of frames that are compressed together as a segment. The first frame of a segment is a key frame.</summary>
        public const int FramesPerSegment = 20;

        /// <summary>Approximate maximum number of stored links per frame, each direction counted.</summary>
        public const int LinkBudget = 60000;

        internal const string Placeholder = "@@REPLAY@@";
        internal const int Version = 6;

        private const int MaxSlots = 1 << 24;

        private readonly string scratchPath;
        private readonly StreamWriter scratch;
        private readonly Action<byte[], int> live;
        private readonly int framesPerSegment;
        private readonly JObject metadata;
        private readonly ReplayField[] fields;
        private readonly ReplayMetrics metrics;
        private readonly List<ReplayMover> movers;
        private readonly ReplayArena arena;
        private readonly double positionStep;
        private readonly ReplaySegment segment;
        private readonly LinkSorter sorter = new LinkSorter();
        private readonly MemoryStream compressed = new MemoryStream();
        private char[] text = new char[0];
        private long textLength;

        private readonly Dictionary<int, int> slotOfId = new Dictionary<int, int>();
        // Slots by the low bits of ids, as a cache for lookups of links. An entry may belong to another id.
        private int[] recent = new int[64];
        // The id of the current or last node of each slot.
        private readonly List<int> ids = new List<int>();
        // Slots of nodes that left before this segment, in descending order.
        private readonly List<int> free = new List<int>();
        private readonly IdRanges allIds = new IdRanges();
        private readonly List<double> times = new List<double>();
        private int slotOfLast;
        private int maxSlots;
        private int maxPairs;

        private ReplayFrame frame;
        private ulong linkLimit;
        private bool inFrame;
        private bool finished;

        /// <param name="scratchPath">
        /// File that stores the frames until <see cref="Finish"/>. It is created or replaced now, and deleted by <see cref="Dispose"/>.
        /// </param>
        /// <param name="metadata">The content of the page other than frames.</param>
        public ReplayWriter(string scratchPath, ReplayMetadata metadata)
            : this(metadata, FramesPerSegment)
        {
            this.scratchPath = scratchPath;
            scratch = ResultFile.Create(scratchPath);
        }

        /// <summary>Creates a writer that does not write a page. Each frame is a separate segment, so that a reader can skip frames.</summary>
        /// <param name="live">Called for each frame with its bytes and their number. The array is reused.</param>
        internal ReplayWriter(ReplayMetadata metadata, Action<byte[], int> live)
            : this(metadata, 1)
        {
            this.live = live;
        }

        private ReplayWriter(ReplayMetadata metadata, int framesPerSegment)
        {
            this.framesPerSegment = framesPerSegment;
            this.metadata = metadata.ToJson();
            fields = new List<ReplayField>(metadata.Fields).ToArray();
            if (fields.Length == 0) throw new ArgumentException("The replay's metadata has no fields: add at least one.", nameof(metadata));
            metrics = metadata.Metrics;
            movers = metadata.Movers;
            segment = new ReplaySegment(fields);
            arena = metadata.Arena.Copy();
            positionStep = Math.Max(arena.LongestSide / 65535, arena.Farthest / (1 << 29));
        }

        /// <summary>Number of frames written.</summary>
        public int Frames { get; private set; }

        /// <summary>Radius of nodes in metres.</summary>
        internal float NodeRadius => (float)metadata["nodeRadius"];

        /// <summary>Maximum number of slots so far.</summary>
        internal int Slots => maxSlots;

        /// <param name="time">Simulated seconds, greater than in the previous frame. Without a page, it may also be equal.</param>
        /// <param name="links">
        /// Number of different links in the frame, each direction counted. If it exceeds <see cref="LinkBudget"/>, only a sample of the links is stored.
        /// The sample consists of the links with the smallest hashes of their nodes' ids, so it changes little from frame to frame.
        /// </param>
        public void BeginFrame(double time, int links = 0)
        {
            if (inFrame || finished) throw Order(nameof(BeginFrame), inFrame ? "the previous frame has not ended" : "the replay is finished");
            var last = Frames == 0 ? double.NegativeInfinity : times[times.Count - 1];
            // A frame of a live page may replace the last one.
            if (!(time > last || live != null && time == last) || double.IsInfinity(time))
                throw new ArgumentException("Frame " + Number(Frames) + " of the replay has time " + Number(time) + ": it must be finite and later than "
                    + Number(last) + ".", nameof(time));
            if (live != null) times.Clear();
            times.Add(time);
            Frames++;
            inFrame = true;
            if (segment.Count == 0 && Frames > 1) FreeSlots();
            frame = segment.Add(ids.Count);
            frame.Links = links;
            linkLimit = links <= LinkBudget ? 1UL << 32 : ((ulong)LinkBudget << 32) / (ulong)links;
        }

        /// <summary>
        /// Adds a node to this frame. Its position is rounded to steps of 1/65535 of the arena's longest side, at least 2^-29 of its farthest coordinate, and
        /// limited to 2^30 steps from the origin.
        /// </summary>
        /// <param name="id">The node's id, the same in all frames.</param>
        /// <param name="value">The node's value of the first field; NaN if it has none.</param>
        public void Node(int id, float x, float y, float z, double value)
        {
            if (!inFrame) throw Order(nameof(Node), "no frame has begun");
            if (!IsFinite(x) || !IsFinite(y) || !IsFinite(z))
                throw new ArgumentException("Node " + Number(id) + " is at (" + Number(x) + ", " + Number(y) + ", " + Number(z) + ") in frame "
                    + Number(Frames - 1) + " of the replay: positions must be finite.");
            if (!slotOfId.TryGetValue(id, out var slot)) slot = NewSlot(id);
            else if (frame.Has(slot))
                throw new ArgumentException("Node " + Number(id) + " occurs twice in frame " + Number(Frames - 1) + " of the replay: add each node once.");
            frame.Set(slot, Steps(x), Steps(y), Steps(z));
            arena.Include(x, y, z);
            slotOfLast = slot;
            recent[id & recent.Length - 1] = slot;
            Value(0, value);
        }

        /// <summary>Sets a value of the node that was added last. Fields that are not set have no value.</summary>
        /// <param name="field">Index in <see cref="ReplayMetadata.Fields"/>.</param>
        /// <param name="value">The value; NaN if missing.</param>
        public void Value(int field, double value)
        {
            var problem = fields[field].FindProblem(value);
            if (problem != null)
                throw new ArgumentException("Node " + Number(ids[slotOfLast]) + " has " + problem + " in frame " + Number(Frames - 1)
                    + " of the replay: use another value, or NaN for no value.");
            frame.SetValue(field, slotOfLast, value);
            fields[field].Include(value);
        }

        /// <summary>Adds a link between two different nodes of this frame. Repetitions have no effect.</summary>
        /// <param name="from">Id of the sender.</param>
        /// <param name="to">Id of the receiver.</param>
        /// <param name="isMutual">Whether to add the link in the other direction too.</param>
        public void Link(int from, int to, bool isMutual = false)
        {
            if (!inFrame) throw Order(nameof(Link), "no frame has begun");
            if (linkLimit <= uint.MaxValue && Hash(Math.Min(from, to), Math.Max(from, to)) >= linkLimit) return;
            int sender = PresentSlot(from, from, to), receiver = PresentSlot(to, from, to);
            if (sender == receiver)
                throw new ArgumentException("Node " + Number(from) + " is linked to itself in frame " + Number(Frames - 1)
                    + " of the replay: omit that link.");
            frame.Link(sender, receiver, isMutual);
        }

        public void EndFrame()
        {
            if (!inFrame) throw Order(nameof(EndFrame), "no frame has begun");
            inFrame = false;
            var storedLinks = frame.End(sorter);
            if (frame.Links <= LinkBudget) frame.Links = storedLinks;
            maxPairs = Math.Max(maxPairs, frame.PairCount);
            if (segment.Count == framesPerSegment) FlushSegment();
        }

        /// <summary>Writes the page, which is the template with the recording. Call it once, after the last frame.</summary>
        /// <param name="templatePath">The page that <c>build.mjs</c> builds.</param>
        /// <param name="outputHtmlPath">The file to create or replace.</param>
        /// <exception cref="InvalidDataException">The file is not a template. No file is written.</exception>
        public void Finish(string templatePath, string outputHtmlPath)
        {
            if (inFrame || finished) throw Order(nameof(Finish), inFrame ? "the last frame has not ended" : "the replay is finished");
            if (Frames == 0) throw Order(nameof(Finish), "the replay has no frames");
            var template = File.ReadAllText(templatePath);
            var start = template.IndexOf(Placeholder, StringComparison.Ordinal);
            if (start < 0 || template.IndexOf(Placeholder, start + 1, StringComparison.Ordinal) >= 0)
                throw new InvalidDataException(templatePath + " is not a replay template (it must contain " + Placeholder + " once): build it with build.mjs.");
            finished = true;
            if (segment.Count > 0) FlushSegment();
            scratch.Dispose();
            var header = Encoding.UTF8.GetBytes(Header().ToString(Formatting.None));
            var headerLength = Compress(header, header.Length);
            ResultFile.Write(outputHtmlPath, page =>
            {
                page.Write(template.Substring(0, start));
                page.Write(text, 0, headerLength);
                var piece = new char[1 << 16];
                using (var segments = new StreamReader(scratchPath))
                    for (int read; (read = segments.Read(piece, 0, piece.Length)) > 0;) page.Write(piece, 0, read);
                page.Write(template.Substring(start + Placeholder.Length));
            });
        }

        /// <summary>Closes and deletes the scratch file, but not a finished page.</summary>
        public void Dispose()
        {
            finished = true;
            try
            {
                scratch?.Dispose();
            }
            finally
            {
                if (scratchPath != null) ResultFile.Delete(scratchPath);
            }
        }

        /// <summary>
        /// Frees the slots of nodes that are not in the last frame. Called between segments only, because slots must not change within a segment.
        /// </summary>
        private void FreeSlots()
        {
            free.Clear();
            for (var slot = ids.Count - 1; slot >= 0; slot--)
            {
                if (frame.Has(slot)) continue;
                if (slotOfId.TryGetValue(ids[slot], out var last) && last == slot) slotOfId.Remove(ids[slot]);
                if (slot == ids.Count - 1) ids.RemoveAt(slot);
                else free.Add(slot);
            }
        }

        private int NewSlot(int id)
        {
            var slot = free.Count == 0 ? ids.Count : free[free.Count - 1];
            if (slot == MaxSlots)
                throw new InvalidOperationException("The replay has " + Number(MaxSlots) + " nodes in a segment, which is the maximum: use fewer nodes.");
            allIds.Add(id);
            slotOfId.Add(id, slot);
            if (slot == ids.Count)
            {
                ids.Add(id);
                maxSlots = Math.Max(maxSlots, ids.Count);
                if (ids.Count > recent.Length) recent = new int[2 * recent.Length];
                return slot;
            }
            ids[slot] = id;
            free.RemoveAt(free.Count - 1);
            return slot;
        }

        private int PresentSlot(int id, int from, int to)
        {
            var slot = recent[id & recent.Length - 1];
            if (slot < ids.Count && ids[slot] == id && frame.Has(slot)) return slot;
            if (slotOfId.TryGetValue(id, out slot) && frame.Has(slot)) return slot;
            throw new ArgumentException("Link " + Number(from) + " - " + Number(to) + ": node " + Number(id) + " is not in frame " + Number(Frames - 1)
                + " of the replay: add the nodes of a frame before its links.");
        }

        private int Steps(float metres)
        {
            const double Limit = 1 << 30;
            return (int)Math.Floor(Math.Max(-Limit, Math.Min(Limit, metres / positionStep)) + 0.5);
        }

        /// <summary>Returns the header of the frames so far or, for a writer without a page, of the last frame.</summary>
        internal JObject Header()
        {
            metadata["arena"] = arena.ToJson();
            return new JObject
            {
                ["version"] = Version,
                ["framesPerSegment"] = framesPerSegment,
                ["length"] = textLength,
                ["positionStep"] = positionStep,
                ["fields"] = new JArray(Array.ConvertAll(fields, field => (object)field.ToJson())),
                ["maxPairs"] = maxPairs,
                ["times"] = new JArray(times),
                ["slots"] = maxSlots,
                ["ids"] = allIds.ToJson(),
                ["metrics"] = (metrics ?? new ReplayMetrics(new string[0])).ToJson(),
                ["movers"] = new JArray(movers.ConvertAll(mover => (object)mover.ToJson())),
                ["metadata"] = metadata,
            };
        }

        private void FlushSegment()
        {
            var count = segment.Encode(ids, out var bytes);
            if (live != null)
            {
                live(bytes, count);
                return;
            }
            var length = Compress(bytes, count);
            scratch.Write('\n');
            scratch.Write(text, 0, length);
            textLength += 1 + length;
        }

        /// <summary>Compresses bytes with gzip, writes them as base64 to <see cref="text"/>, and returns the length.</summary>
        private int Compress(byte[] bytes, int count)
        {
            compressed.SetLength(0);
            using (var gzip = new GZipStream(compressed, CompressionLevel.Optimal, true)) gzip.Write(bytes, 0, count);
            var length = (int)compressed.Length;
            var needed = (length + 2) / 3 * 4;
            if (text.Length < needed) text = new char[needed + needed / 4];
            return Convert.ToBase64CharArray(compressed.GetBuffer(), 0, length, text, 0);
        }

        /// <summary>Returns a 32-bit hash of a link.</summary>
        private static uint Hash(int low, int high)
        {
            unchecked
            {
                var mixed = (uint)low * 0x9E3779B1u ^ (uint)high * 0x85EBCA77u;
                mixed = (mixed ^ mixed >> 16) * 0x85EBCA6Bu;
                mixed = (mixed ^ mixed >> 13) * 0xC2B2AE35u;
                return mixed ^ mixed >> 16;
            }
        }

        private static bool IsFinite(float value) => !float.IsNaN(value) && !float.IsInfinity(value);

        private static string Number(double value) => value.ToString("R", CultureInfo.InvariantCulture);

        private static InvalidOperationException Order(string call, string why) =>
            new InvalidOperationException("ReplayWriter." + call + ": " + why
                + ". The order is BeginFrame, Node..., Link..., EndFrame for each frame, then Finish.");
    }
}
