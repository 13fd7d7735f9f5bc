using System;
using System.Collections.Generic;
using System.IO;
using Newtonsoft.Json;

namespace Collektive.Headless.Samples
{
    /// <summary>
    /// Writes an artificial run for the test of the page. Nodes walk at random, join and leave. Each has a link to the next two nodes, and every
    /// third one has a link back.
    /// The file OUTPUT.html.expected.json contains the expected content of some frames.
    /// Usage: SampleReplay.exe TEMPLATE OUTPUT.html NODES FRAMES
    /// </summary>
    internal static class SampleReplay
    {
        private const int Checked = 37;
        private const double Step = 0.1;

        private static void Main(string[] args)
        {
            int nodeCount = int.Parse(args[2]), frames = int.Parse(args[3]);
            var fields = new[] { new ReplayField("brightness") { Unit = "lx" }, new ReplayField("leader", ReplayFieldKind.Category) };
            var metrics = new ReplayMetrics(new[] { "bytes", "links" });
            var metadata = new ReplayMetadata
            {
                Title = "Sample run", Seed = ulong.MaxValue, DeltaTime = Step, Fields = fields, Metrics = metrics, NodeHeight = 1.5f,
            };
            metadata.SetArena(-50, 0, -30, 50, 5, 30);
            metadata.AddBox(9, 1.5f, -9, 1, 3, 5);
            metadata.AddSphere(-9, 1, 9, 1);
            metadata.AddCapsule(15, 3, 15, 1, 6, 1, 0, 0, 0, 1);
            metadata.AddMarker("lamp \"A\"", 25, 0, 0);
            var random = new Random(42);
            var places = new float[2 * nodeCount];
            for (var i = 0; i < places.Length; i++) places[i] = 50 * (float)random.NextDouble() - 25;
            var expected = new List<object>();
            using (var writer = new ReplayWriter(args[1] + ".scratch", metadata))
            {
                for (var frame = 0; frame < frames; frame++)
                {
                    for (var i = 0; i < places.Length; i++) places[i] += (float)random.NextDouble() - 0.5f;
                    var nodes = new List<float?[]>();
                    var links = new List<int[]>();
                    writer.BeginFrame(frame * Step);
                    for (var id = 0; id < nodeCount; id++) if (Exists(id, frame)) nodes.Add(Write(writer, id, places));
                    for (var link = 0; link < 2 * nodeCount; link++)
                    {
                        int a = link / 2, b = (a + 1 + link % 2) % nodeCount;
                        if (!Exists(a, frame) || !Exists(b, frame)) continue;
                        writer.Link(a, b);
                        links.Add(new[] { a, b });
                        if (a % 3 != 0) continue;
                        writer.Link(b, a);
                        links.Add(new[] { b, a });
                    }
                    writer.EndFrame();
                    metrics.Add(frame * Step, new[] { 1234567.0 * frame, links.Count });
                    if (frame % Checked == 0) expected.Add(new { frame, time = frame * Step, nodes, links });
                }
                writer.Finish(args[0], args[1]);
            }
            File.WriteAllText(args[1] + ".expected.json", JsonConvert.SerializeObject(expected));
        }

        private static bool Exists(int id, int frame) => id % 7 != 0 || (frame + id) % 90 < 60;

        private static float?[] Write(ReplayWriter writer, int id, float[] places)
        {
            float x = places[2 * id], z = places[2 * id + 1], scalar = id % 10 == 0 ? float.NaN : x + z;
            writer.Node(id, x, 0.25f, z, scalar);
            // In most palettes by number, 0 and 144 are nearly equal.
            writer.Value(1, 144 * (id % 9));
            return new[] { id, x, 0.25f, z, float.IsNaN(scalar) ? (float?)null : scalar };
        }
    }
}
