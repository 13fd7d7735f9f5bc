using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;

namespace Collektive.Headless.Tests
{
    /// <summary>
    /// Writes a made-up run for work on the page and its test: a crowd drifts round four walls to a lamp. Beside it lies
    /// OUTPUT.html.expected.json, what some of its frames must show.
    /// Usage: SampleReplay.exe TEMPLATE OUTPUT.html [nodes] [frames]
    /// </summary>
    internal static class SampleReplay
    {
        private const float LampX = 25, Range = 3, Radius = 0.25f;
        private const double Step = 0.1;

        private static int Main(string[] args)
        {
            if (args.Length < 2)
            {
                Console.Error.WriteLine("Usage: SampleReplay.exe TEMPLATE OUTPUT.html [nodes] [frames]");
                return 2;
            }
            var nodes = args.Length > 2 ? int.Parse(args[2], CultureInfo.InvariantCulture) : 500;
            var frames = args.Length > 3 ? int.Parse(args[3], CultureInfo.InvariantCulture) : 600;
            var metadata = new ReplayMetadata
            {
                Title = "Sample run", Seed = 42, DeltaTime = Step, NodeRadius = Radius, ScalarName = "brightness", ScalarMin = 0, ScalarMax = 100,
            };
            metadata.SetArena(-50, 0, -30, 50, 5, 30);
            for (var i = 0; i < 4; i++) metadata.AddBox(9 + 2 * (i & 1), 1.5f, -9 + 6 * i, 1, 3, 5);
            metadata.AddMarker("lamp", LampX, 0, 0);

            var random = new Random(42);
            float[] x = new float[nodes], z = new float[nodes];
            var spread = (float)Math.Sqrt(nodes / 500.0);
            for (var i = 0; i < nodes; i++)
            {
                x[i] = -15 + 40 * spread * ((float)random.NextDouble() - 0.5f);
                z[i] = 50 * Math.Min(spread, 1.1f) * ((float)random.NextDouble() - 0.5f);
            }
            var expected = new List<string>();
            using (var writer = new ReplayWriter(args[1] + ".scratch", metadata))
            {
                for (var frame = 0; frame < frames; frame++)
                {
                    writer.BeginFrame(frame * Step);
                    var present = new List<string>();
                    var links = new List<string>();
                    for (var i = 0; i < nodes; i++)
                    {
                        if (!Exists(i, frame)) continue;
                        var scalar = i % 97 == 0 ? float.NaN : Math.Max(0, 100 - 1.6f * Length(x[i] - LampX, z[i]));
                        writer.Node(i, x[i], Radius, z[i], scalar);
                        present.Add(Array(i, x[i], Radius, z[i], scalar));
                    }
                    Move(writer, links, x, z, frame);
                    writer.EndFrame();
                    if (frame % Math.Max(1, frames / 4) == 0)
                        expected.Add("{\"frame\":" + Number(frame) + ",\"time\":" + Number(frame * Step) +
                            ",\"nodes\":[" + string.Join(",", present) + "],\"links\":[" + string.Join(",", links) + "]}");
                }
                writer.Finish(args[0], args[1]);
            }
            File.WriteAllText(args[1] + ".expected.json", "[" + string.Join(",\n", expected) + "]\n");
            return 0;
        }

        private static string Array(params double[] values) => "[" + string.Join(",", System.Array.ConvertAll(values, Number)) + "]";

        private static string Number(double value) => double.IsNaN(value) ? "null" : value.ToString("R", CultureInfo.InvariantCulture);

        // Every fiftieth node comes late and leaves early.
        private static bool Exists(int node, int frame) => node % 50 != 0 || (frame >= 50 && frame < 400);

        private static void Move(ReplayWriter writer, List<string> links, float[] x, float[] z, int frame)
        {
            var cells = new Dictionary<(int, int), List<int>>();
            for (var i = 0; i < x.Length; i++)
            {
                var cell = Cell(x[i], z[i]);
                if (!cells.TryGetValue(cell, out var list)) cells.Add(cell, list = new List<int>());
                list.Add(i);
            }
            float[] pushX = new float[x.Length], pushZ = new float[x.Length];
            for (var i = 0; i < x.Length; i++)
            {
                var (cellX, cellZ) = Cell(x[i], z[i]);
                for (var around = 0; around < 9; around++)
                {
                    if (!cells.TryGetValue((cellX + around % 3 - 1, cellZ + around / 3 - 1), out var list)) continue;
                    foreach (var other in list)
                    {
                        float awayX = x[i] - x[other], awayZ = z[i] - z[other], distance = Length(awayX, awayZ);
                        if (other == i || distance > Range) continue;
                        if (other > i && Exists(i, frame) && Exists(other, frame))
                        {
                            writer.Link(i, other);
                            links.Add(Array(i, other));
                        }
                        if (distance > 0.62f || distance < 1e-4f) continue;
                        pushX[i] += awayX / distance * (0.62f - distance) * 0.45f;
                        pushZ[i] += awayZ / distance * (0.62f - distance) * 0.45f;
                    }
                }
            }
            for (var i = 0; i < x.Length; i++)
            {
                var distance = Length(x[i] - LampX, z[i]);
                var speed = Math.Min(2.2f, distance * 0.12f) * (float)Step;
                var sway = 0.6f * (float)Math.Sin(0.13 * frame + i);
                float moveX = (LampX - x[i]) / (distance + 0.01f) * speed, moveZ = -z[i] / (distance + 0.01f) * speed + sway * speed * 0.4f;
                if (x[i] > 6.5f && x[i] < 12 && InsideWall(x[i] + moveX + 0.4f, z[i], out var centre))
                {
                    moveX = 0;
                    moveZ = (z[i] >= centre ? 1 : -1) * 2 * (float)Step;
                }
                x[i] += moveX + pushX[i];
                z[i] += moveZ + pushZ[i];
            }
        }

        private static bool InsideWall(float x, float z, out float centre)
        {
            for (var i = 0; i < 4; i++)
            {
                centre = -9 + 6 * i;
                if (Math.Abs(x - (9 + 2 * (i & 1))) < 0.9f && Math.Abs(z - centre) < 2.8f) return true;
            }
            centre = 0;
            return false;
        }

        private static (int, int) Cell(float x, float z) => ((int)Math.Floor(x / Range), (int)Math.Floor(z / Range));

        private static float Length(float x, float z) => (float)Math.Sqrt(x * x + z * z);
    }
}
