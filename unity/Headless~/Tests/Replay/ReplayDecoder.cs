using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Text;

namespace Collektive.Headless.Tests
{
    /// <summary>Reads a replay page after FORMAT.md alone, with none of the writer's code.</summary>
    internal sealed class ReplayDecoder
    {
        internal struct Node
        {
            public float X, Y, Z, Scalar;
        }

        internal sealed class Frame
        {
            public double Time;
            public readonly Dictionary<int, Node> Nodes = new Dictionary<int, Node>();
            public readonly HashSet<(int, int)> Links = new HashSet<(int, int)>(); // lesser id first
            public int LinksChanged;
        }

        public readonly string Json;
        public readonly List<Frame> Frames = new List<Frame>();

        public ReplayDecoder(string html, string before, string after)
        {
            if (!html.StartsWith(before, StringComparison.Ordinal) || !html.EndsWith(after, StringComparison.Ordinal))
                throw new InvalidDataException("the template is not kept");
            var gzip = Convert.FromBase64String(html.Substring(before.Length, html.Length - before.Length - after.Length));
            var bytes = new MemoryStream();
            using (var stream = new GZipStream(new MemoryStream(gzip), CompressionMode.Decompress)) stream.CopyTo(bytes);
            bytes.Position = 0;
            var reader = new BinaryReader(bytes);
            if (Encoding.ASCII.GetString(reader.ReadBytes(4)) != "CLKR") throw new InvalidDataException("magic");
            if (reader.ReadUInt32() != 1) throw new InvalidDataException("version");
            Json = Encoding.UTF8.GetString(reader.ReadBytes(reader.ReadInt32()));

            var ids = new List<int>();
            var links = new HashSet<(int, int)>();
            for (int length; (length = reader.ReadInt32()) != 0;)
            {
                var end = bytes.Position + length;
                Frames.Add(ReadFrame(reader, ids, links));
                if (bytes.Position != end) throw new InvalidDataException("frame length");
            }
            if (bytes.Position != bytes.Length) throw new InvalidDataException("bytes after the end");
        }

        private static Frame ReadFrame(BinaryReader reader, List<int> ids, HashSet<(int, int)> links)
        {
            var frame = new Frame { Time = reader.ReadDouble() };
            for (var count = reader.ReadInt32(); count > 0; count--) ids.Add(reader.ReadInt32());
            var bits = reader.ReadBytes((ids.Count + 7) / 8);
            var present = new List<int>();
            for (var slot = 0; slot < ids.Count; slot++)
                if ((bits[slot >> 3] >> (slot & 7) & 1) != 0) present.Add(slot);
            var ranges = new float[8];
            for (var i = 0; i < 8; i++) ranges[i] = reader.ReadSingle();
            var columns = new float[4][];
            for (var column = 0; column < 4; column++)
            {
                columns[column] = new float[present.Count];
                for (var i = 0; i < present.Count; i++)
                {
                    int q = reader.ReadUInt16(), steps = column == 3 ? 65534 : 65535;
                    columns[column][i] = q > steps ? float.NaN : (float)(ranges[column] + q * ((double)ranges[column + 4] - ranges[column]) / steps);
                }
            }
            for (var i = 0; i < present.Count; i++)
                frame.Nodes.Add(ids[present[i]], new Node { X = columns[0][i], Y = columns[1][i], Z = columns[2][i], Scalar = columns[3][i] });

            foreach (var pair in ReadPairs(reader))
            {
                frame.LinksChanged++;
                if (!links.Remove(pair)) throw new InvalidDataException("removed link that was not there");
            }
            foreach (var pair in ReadPairs(reader))
            {
                frame.LinksChanged++;
                if (!links.Add(pair)) throw new InvalidDataException("added link that was there");
            }
            foreach (var (a, b) in links)
            {
                if (!frame.Nodes.ContainsKey(ids[a]) || !frame.Nodes.ContainsKey(ids[b])) throw new InvalidDataException("link of an absent node");
                frame.Links.Add((Math.Min(ids[a], ids[b]), Math.Max(ids[a], ids[b])));
            }
            return frame;
        }

        private static List<(int, int)> ReadPairs(BinaryReader reader)
        {
            var pairs = new List<(int, int)>();
            int a = -1, b = 0;
            for (var count = reader.ReadInt32(); count > 0; count--)
            {
                var step = ReadVarint(reader);
                b = (step == 0 ? b : a + step) + ReadVarint(reader);
                a += step;
                if (a >= b) throw new InvalidDataException("pair out of order");
                pairs.Add((a, b));
            }
            return pairs;
        }

        private static int ReadVarint(BinaryReader reader)
        {
            var value = 0;
            for (var shift = 0; ; shift += 7)
            {
                var part = reader.ReadByte();
                value |= (part & 0x7f) << shift;
                if (part < 0x80) return value;
            }
        }
    }
}
