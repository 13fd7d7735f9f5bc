using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Text;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless.Tests
{
    /// <summary>Decodes a replay page as FORMAT.md describes it, and shares no code with the writer.</summary>
    internal sealed class ReplayDecoder
    {
        internal struct Node
        {
            public float X, Y, Z, Scalar; // the value of the first field
            public double[] Values; // the values of all fields, NaN if missing
        }

        internal sealed class Frame
        {
            public double Time;
            public readonly Dictionary<int, Node> Nodes = new Dictionary<int, Node>();
            public readonly HashSet<(int, int)> Links = new HashSet<(int, int)>(); // from, to
            public int LinksInAll, LinksChanged;
        }

        public readonly JObject Header;
        public readonly List<Frame> Frames = new List<Frame>();

        private readonly double step;
        private readonly int slots;
        private int[] ids; // the ids of the nodes in the segment
        private readonly double[] times;

        public ReplayDecoder(string html, string before, string after)
        {
            if (!html.StartsWith(before, StringComparison.Ordinal) || !html.EndsWith(after, StringComparison.Ordinal))
                throw new InvalidDataException("the template was changed");
            var text = html.Substring(before.Length, html.Length - before.Length - after.Length);
            var lines = text.Split('\n');
            Header = JObject.Parse(Encoding.UTF8.GetString(Unpack(lines[0])));
            if ((int)Header["version"] != 6) throw new InvalidDataException("version");
            if ((int)Header["length"] != text.Length - lines[0].Length) throw new InvalidDataException("length");
            step = (double)Header["positionStep"];
            slots = (int)Header["slots"];
            times = Header["times"].ToObject<double[]>();
            var perSegment = (int)Header["framesPerSegment"];
            if (lines.Length - 1 != (times.Length + perSegment - 1) / perSegment) throw new InvalidDataException("number of segments");
            for (var i = 1; i < lines.Length; i++) ReadSegment(Unpack(lines[i]), Math.Min(i * perSegment, times.Length));
        }

        private static byte[] Unpack(string base64)
        {
            var bytes = new MemoryStream();
            using (var stream = new GZipStream(new MemoryStream(Convert.FromBase64String(base64)), CompressionMode.Decompress)) stream.CopyTo(bytes);
            return bytes.ToArray();
        }

        private void ReadSegment(byte[] bytes, int end)
        {
            var reader = new BinaryReader(new MemoryStream(bytes));
            var fields = (JArray)Header["fields"];
            var ranges = new (double Min, double Max)[fields.Count];
            for (var field = 0; field < fields.Count; field++)
                if ((string)fields[field]["kind"] == "number") ranges[field] = (reader.ReadDouble(), reader.ReadDouble());
            ids = new int[ReadNumber(reader)];
            if (ids.Length > slots) throw new InvalidDataException("number of slots");
            for (var slot = 0; slot < ids.Length; slot++) ids[slot] = unchecked((slot == 0 ? 0 : ids[slot - 1]) + ReadSigned(reader));
            var last = new int[3 + fields.Count, ids.Length];
            var motion = new int[3 + fields.Count, ids.Length];
            var seen = new HashSet<int>();
            var links = new HashSet<(int, int)>();
            while (Frames.Count < end)
            {
                var frame = new Frame { Time = times[Frames.Count] };
                var present = ReadPresence(reader);
                for (var column = 0; column < 3 + fields.Count; column++)
                {
                    foreach (var slot in present)
                    {
                        var moved = unchecked(motion[column, slot] + ReadSigned(reader));
                        last[column, slot] = unchecked(last[column, slot] + moved);
                        if (seen.Contains(slot)) motion[column, slot] = moved;
                    }
                }
                seen.UnionWith(present);
                foreach (var slot in present)
                {
                    var values = new double[fields.Count];
                    for (var field = 0; field < fields.Count; field++)
                    {
                        var q = last[3 + field, slot];
                        var (min, max) = ranges[field];
                        var isNumber = (string)fields[field]["kind"] == "number";
                        values[field] = q == 0 ? double.NaN : isNumber ? min + ((uint)q - 1) * (max - min) / 65534 : (q - 1) >> 1 ^ -((q - 1) & 1);
                    }
                    float Metres(int axis) => (float)(last[axis, slot] * step);
                    frame.Nodes.Add(ids[slot], new Node { X = Metres(0), Y = Metres(1), Z = Metres(2), Scalar = (float)values[0], Values = values });
                }
                ReadLinks(reader, frame, links);
                Frames.Add(frame);
            }
            if (reader.BaseStream.Position != bytes.Length) throw new InvalidDataException("the page has bytes after the end");
        }

        private static List<int> ReadPresence(BinaryReader reader)
        {
            var slots = (int)ReadNumber(reader);
            var bits = reader.ReadBytes((slots + 7) / 8);
            var present = new List<int>();
            for (var slot = 0; slot < slots; slot++)
                if ((bits[slot >> 3] >> (slot & 7) & 1) != 0) present.Add(slot);
            return present;
        }

        private void ReadLinks(BinaryReader reader, Frame frame, HashSet<(int, int)> links)
        {
            frame.LinksInAll = (int)ReadNumber(reader);
            foreach (var pair in ReadPairs(reader))
            {
                frame.LinksChanged++;
                if (!links.Remove(pair)) throw new InvalidDataException("a removed link did not exist");
            }
            foreach (var pair in ReadPairs(reader))
            {
                frame.LinksChanged++;
                if (!links.Add(pair)) throw new InvalidDataException("an added link already existed");
            }
            foreach (var (a, b) in links)
            {
                if (!frame.Nodes.ContainsKey(ids[a]) || !frame.Nodes.ContainsKey(ids[b])) throw new InvalidDataException("a link refers to an absent node");
                frame.Links.Add((ids[a], ids[b]));
            }
        }

        private static List<(int, int)> ReadPairs(BinaryReader reader)
        {
            var pairs = new List<(int, int)>();
            int a = -1, b = 0;
            for (var count = ReadNumber(reader); count > 0; count--)
            {
                var further = (int)ReadNumber(reader);
                var rest = (int)ReadNumber(reader);
                b = (further == 0 ? b : a + further) + (rest >> 2);
                a += further;
                if (a >= b || (rest & 3) == 0) throw new InvalidDataException("a pair is out of order, or has no link");
                if ((rest & 1) != 0) pairs.Add((a, b));
                if ((rest & 2) != 0) pairs.Add((b, a));
            }
            return pairs;
        }

        private static int ReadSigned(BinaryReader reader)
        {
            var coded = ReadNumber(reader);
            return (int)(coded >> 1) ^ -(int)(coded & 1);
        }

        private static uint ReadNumber(BinaryReader reader)
        {
            uint value = 0;
            for (var shift = 0; ; shift += 7)
            {
                var part = reader.ReadByte();
                value |= (uint)(part & 0x7f) << shift;
                if (part < 0x80) return value;
            }
        }
    }
}
