using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Threading;
using Newtonsoft.Json;
using NUnit.Framework;

namespace Collektive.Headless.Tests
{
    [TestFixture, Category("AnyPlacement")]
    public sealed class ReplayWriterTests
    {
        /// <summary>The resolution of positions in the default arena of 20 m.</summary>
        private const double Step = 20.0 / 65535;

        private const string Before = "<html><script>", After = "</script> ü </html>";

        private string folder;
        private string scratch;
        private string template;
        private string page;

        [SetUp]
        public void MakeFolder()
        {
            folder = Path.Combine(Path.GetTempPath(), "replay-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
            scratch = Path.Combine(folder, "scratch");
            template = Path.Combine(folder, "template.html");
            page = Path.Combine(folder, "replay.html");
            File.WriteAllText(template, Before + "@@REPLAY@@" + After);
        }

        [TearDown]
        public void DeleteFolder() => Directory.Delete(folder, true);

        [Test]
        public void AFrameCanBeEmpty()
        {
            var replay = Record(writer => Frame(writer, 0));
            Assert.AreEqual(1, replay.Frames.Count);
            Assert.AreEqual(0, replay.Frames[0].Nodes.Count);
            Assert.AreEqual(0, replay.Frames[0].Links.Count);
        }

        [Test]
        public void LinksDisappearWithTheirNodes()
        {
            var replay = Record(writer =>
            {
                Frame(writer, 0, 7, -3, 9);
                writer.BeginFrame(1);
                foreach (var id in new[] { 7, -3, 9 }) writer.Node(id, id, 0, 0, id);
                writer.Link(7, 9);
                writer.Link(-3, 9);
                writer.EndFrame();
                Frame(writer, 2, 9, 7);
                Frame(writer, 3);
                writer.BeginFrame(4);
                writer.Node(-3, 1, 2, 3, 4);
                writer.Node(100, 5, 6, 7, 8);
                writer.Link(100, -3);
                writer.EndFrame();
            });
            CollectionAssert.AreEquivalent(new[] { 7, -3, 9 }, replay.Frames[0].Nodes.Keys);
            CollectionAssert.AreEquivalent(new[] { (7, 9), (-3, 9) }, replay.Frames[1].Links);
            CollectionAssert.AreEquivalent(new[] { 7, 9 }, replay.Frames[2].Nodes.Keys);
            Assert.AreEqual(0, replay.Frames[2].Links.Count);
            Assert.AreEqual(0, replay.Frames[3].Nodes.Count);
            CollectionAssert.AreEquivalent(new[] { (100, -3) }, replay.Frames[4].Links);
            Assert.AreEqual(6f, replay.Frames[4].Nodes[100].Y, Step / 2 + 1e-6);
        }

        [Test]
        public void SlotsOfDepartedNodesAreReused()
        {
            const int Nodes = 200, Stay = 5;
            long Memory(ReplayWriter writer, ref int next, int segments)
            {
                for (var i = 0; i < segments * ReplayWriter.FramesPerSegment; i++)
                {
                    // In each frame, new nodes replace a tenth of the nodes.
                    next += Nodes / 10;
                    writer.BeginFrame(next);
                    for (var id = 0; id < Stay; id++) writer.Node(id, 0, 0, 0, id);
                    for (var id = next; id < next + Nodes; id++) writer.Node(id, 0, 0, 0, id);
                    writer.EndFrame();
                }
                return GC.GetTotalMemory(true);
            }
            var ids = 0;
            long before = 0, after = 0;
            var replay = Record(writer =>
            {
                before = Memory(writer, ref ids, 20);
                after = Memory(writer, ref ids, 200);
            });
            Assert.Less(after - before, 200000, "the writer must not keep the memory of 80,000 nodes that have left");
            Assert.Less((int)replay.Header["slots"], 4 * Nodes);
            CollectionAssert.AreEqual(new[] { 0, Stay - 1, Nodes / 10, ids + Nodes - 1 }, replay.Header["ids"].ToObject<int[]>());
            for (var i = 0; i < replay.Frames.Count; i++)
            {
                Assert.AreEqual(Stay + Nodes, replay.Frames[i].Nodes.Count);
                Assert.IsTrue(replay.Frames[i].Nodes.ContainsKey((i + 1) * (Nodes / 10)));
            }
        }

        [Test]
        public void AReturningNodeCanGetAnotherSlot()
        {
            var replay = Record(writer =>
            {
                for (var time = 0; time < 5 * ReplayWriter.FramesPerSegment; time++)
                {
                    var round = time / ReplayWriter.FramesPerSegment;
                    if (round % 2 == 0) Frame(writer, time, 1, 2, 3 + round);
                    else Frame(writer, time, 2);
                }
            });
            CollectionAssert.AreEqual(new[] { 1, 3, 5, 5, 7, 7 }, replay.Header["ids"].ToObject<int[]>());
            Assert.AreEqual(3, (int)replay.Header["slots"]);
            for (var time = 0; time < replay.Frames.Count; time++)
            {
                var round = time / ReplayWriter.FramesPerSegment;
                CollectionAssert.AreEquivalent(round % 2 == 0 ? new[] { 1, 2, 3 + round } : new[] { 2 }, replay.Frames[time].Nodes.Keys);
            }
        }

        [Test]
        public void LinksAreDirectedAndDuplicatesAreMerged()
        {
            var replay = Record(writer =>
            {
                for (var time = 0; time < 2; time++)
                {
                    writer.BeginFrame(time);
                    for (var id = 1; id < 4; id++) writer.Node(id, id, 0, 0, 0);
                    writer.Link(1, 2);
                    if (time == 0) writer.Link(2, 1);
                    writer.Link(1, 2);
                    writer.Link(3, 2);
                    writer.EndFrame();
                }
            });
            CollectionAssert.AreEquivalent(new[] { (1, 2), (2, 1), (3, 2) }, replay.Frames[0].Links);
            Assert.AreEqual(3, replay.Frames[0].LinksInAll);
            CollectionAssert.AreEquivalent(new[] { (1, 2), (3, 2) }, replay.Frames[1].Links);
        }

        [Test]
        public void UnchangedLinksAreNotStoredAgain()
        {
            var replay = Record(writer =>
            {
                for (var time = 0; time < 3; time++)
                {
                    writer.BeginFrame(time);
                    for (var id = 0; id < 5; id++) writer.Node(id, id, 0, 0, 0);
                    for (var id = 1; id < 5; id++) writer.Link(0, id);
                    if (time == 2) writer.Link(3, 4);
                    writer.EndFrame();
                }
            });
            Assert.AreEqual(4, replay.Frames[0].LinksChanged);
            Assert.AreEqual(0, replay.Frames[1].LinksChanged);
            Assert.AreEqual(1, replay.Frames[2].LinksChanged);
            Assert.AreEqual(5, replay.Frames[2].Links.Count);
        }

        [Test]
        public void AMissingScalarIsReadAsNaN()
        {
            var replay = Record(writer =>
            {
                writer.BeginFrame(0);
                writer.Node(1, 0, 0, 0, float.NaN);
                writer.Node(2, 0, 0, 0, -5);
                writer.Node(3, 0, 0, 0, 5);
                writer.EndFrame();
            });
            Assert.IsNaN(replay.Frames[0].Nodes[1].Scalar);
            Assert.AreEqual(-5f, replay.Frames[0].Nodes[2].Scalar);
            Assert.AreEqual(5f, replay.Frames[0].Nodes[3].Scalar);
        }

        [Test]
        public void ExtremeScalarsRoundTrip()
        {
            var replay = Record(writer =>
            {
                writer.BeginFrame(0);
                writer.Node(1, 0, 0, 0, float.MinValue);
                writer.Node(2, 0, 0, 0, float.MaxValue);
                writer.EndFrame();
            });
            Assert.AreEqual(float.MinValue, replay.Frames[0].Nodes[1].Scalar);
            Assert.AreEqual(float.MaxValue, replay.Frames[0].Nodes[2].Scalar);
        }

        [Test]
        public void ScalarsInATinyRangeAreNotMissing()
        {
            var replay = Record(writer =>
            {
                writer.BeginFrame(0);
                writer.Node(1, 0, 0, 0, 0);
                writer.Node(2, 0, 0, 0, 1e-310);
                writer.EndFrame();
            });
            Assert.AreEqual(0, replay.Frames[0].Nodes[2].Scalar, 1e-300);
        }

        [Test]
        public void ScalarsFarFromZeroKeepTheirDifferences()
        {
            var replay = Record(writer =>
            {
                writer.BeginFrame(0);
                for (var id = 0; id < 5; id++) writer.Node(id, 0, 0, 0, 1e9 + id);
                writer.EndFrame();
            });
            for (var id = 0; id < 5; id++) Assert.AreEqual(1e9 + id, replay.Frames[0].Nodes[id].Values[0], 4.0 / 65534);
        }

        /// <summary>For example hops, with Int.MAX_VALUE at nodes without a path.</summary>
        [TestCase(int.MaxValue)]
        [TestCase(int.MinValue)]
        [TestCase(uint.MaxValue - 1)]
        public void WholeNumbersAreExact(double outlier)
        {
            var replay = Record(writer =>
            {
                for (var time = 0; time < 3; time++)
                {
                    writer.BeginFrame(time);
                    writer.Node(1, 0, 0, 0, outlier);
                    for (var id = 2; id < 7; id++) writer.Node(id, 0, 0, 0, time == 0 ? double.NaN : id * time - 2);
                    writer.EndFrame();
                }
            });
            for (var time = 1; time < 3; time++)
            {
                Assert.AreEqual(outlier, replay.Frames[time].Nodes[1].Values[0]);
                for (var id = 2; id < 7; id++) Assert.AreEqual(id * time - 2, replay.Frames[time].Nodes[id].Values[0]);
            }
            Assert.IsNaN(replay.Frames[0].Nodes[2].Values[0]);
        }

        [Test]
        public void ANodeFarOutsideTheArenaDoesNotReduceThePrecisionOfOthers()
        {
            var far = (float)(Step * (1 << 30));
            var replay = Record(writer =>
            {
                for (var time = 0; time < 5; time++)
                {
                    writer.BeginFrame(time);
                    writer.Node(1, 1.2345f, 0, 0, 0);
                    writer.Node(2, time % 2 == 0 ? float.MinValue : float.MaxValue, -1e6f * time, 0, 0);
                    writer.EndFrame();
                }
            });
            for (var time = 0; time < 5; time++)
            {
                Assert.AreEqual(1.2345f, replay.Frames[time].Nodes[1].X, Step / 2 + 1e-6);
                Assert.AreEqual(time % 2 == 0 ? -far : far, replay.Frames[time].Nodes[2].X, "the position must be the farthest one that can be stored");
                Assert.AreEqual(Math.Max(-1e6f * time, -far), replay.Frames[time].Nodes[2].Y, 1);
            }
        }

        [Test]
        public void AnArenaFarFromTheOriginKeepsPositions()
        {
            var metadata = new ReplayMetadata();
            metadata.SetArena(5e6f, 0, 0, 5e6f + 64, 1, 64);
            var replay = Record(writer =>
            {
                writer.BeginFrame(0);
                writer.Node(1, 5e6f, 0, 0, 0);
                writer.Node(2, 5e6f + 64, 0, 64, 0);
                writer.EndFrame();
            }, metadata);
            Assert.AreEqual(5e6f, replay.Frames[0].Nodes[1].X, 0.5);
            Assert.AreEqual(5e6f + 64, replay.Frames[0].Nodes[2].X, 0.5);
            Assert.AreEqual(64, replay.Frames[0].Nodes[2].Z, 0.01);
        }

        [TestCase(false, "[-1.0,0.0,-2.0]", "[3.0,1.0,2.0]", TestName = "AFixedArenaIsUnchanged")]
        [TestCase(true, "[-1.0,-4.0,-2.5]", "[7.0,1.0,2.0]", TestName = "AGrowingArenaExtendsByAtMostItsLongestSide")]
        public void Arena(bool grows, string least, string greatest)
        {
            var metadata = new ReplayMetadata();
            metadata.SetArena(-1, 0, -2, 3, 1, 2, grows);
            for (var time = 0; time < 2; time++)
            {
                var replay = Record(writer =>
                {
                    writer.BeginFrame(0);
                    writer.Node(1, 1e6f, -1e6f, -2.5f, 0);
                    writer.EndFrame();
                }, metadata);
                Assert.AreEqual("{\"min\":" + least + ",\"max\":" + greatest + "}", replay.Header["metadata"]["arena"].ToString(Formatting.None));
            }
        }

        [Test]
        public void LinksAboveTheBudgetAreSampledConsistently()
        {
            const int Nodes = 400;
            var replay = Record(writer =>
            {
                for (var time = 0; time < 3; time++)
                {
                    writer.BeginFrame(time, Nodes * (Nodes - 1) / 2);
                    for (var id = 0; id < Nodes; id++) writer.Node(id, id, 0, 0, 0);
                    for (var a = 0; a < Nodes; a++)
                        for (var b = 0; b < a; b++) writer.Link(a, b);
                    writer.EndFrame();
                }
            });
            foreach (var frame in replay.Frames)
            {
                Assert.AreEqual(Nodes * (Nodes - 1) / 2, frame.LinksInAll);
                Assert.AreEqual(ReplayWriter.LinkBudget, frame.Links.Count, 0.02 * ReplayWriter.LinkBudget);
                Assert.IsTrue(frame.Links.SetEquals(replay.Frames[0].Links), "the frame must have the same links as the first frame");
            }
            var ofNode = new int[Nodes];
            foreach (var (a, b) in replay.Frames[0].Links)
            {
                ofNode[a]++;
                ofNode[b]++;
            }
            Assert.Greater(ofNode.Min(), 90, "each node must keep about 150 of its 399 links");
        }

        [Test]
        public void LinksBelowTheBudgetAreAllStored()
        {
            var replay = Record(writer =>
            {
                writer.BeginFrame(0, 3);
                for (var id = 0; id < 4; id++) writer.Node(id, id, 0, 0, 0);
                for (var id = 1; id < 4; id++) writer.Link(0, id);
                writer.EndFrame();
            });
            Assert.AreEqual(3, replay.Frames[0].Links.Count);
            Assert.AreEqual(3, replay.Frames[0].LinksInAll);
        }

        [Test]
        public void AMovingNodeTakesUnderFiveBytesPerFrame()
        {
            const int Nodes = 1000, Frames = 100;
            var random = new Random(1);
            var places = new double[4 * Nodes]; // x, z and the velocities along them
            for (var i = 0; i < places.Length; i++) places[i] = i % 4 < 2 ? 20 * random.NextDouble() - 10 : random.NextDouble() - 0.5;
            Record(writer =>
            {
                for (var frame = 0; frame < Frames; frame++)
                {
                    writer.BeginFrame(0.2 * frame);
                    for (var id = 0; id < Nodes; id++)
                    {
                        int x = 4 * id, z = x + 1;
                        for (var axis = x; axis <= z; axis++)
                        {
                            // Bodies change their direction slowly.
                            places[axis + 2] += 0.02 * (random.NextDouble() - 0.5);
                            places[axis] += 0.2 * places[axis + 2];
                        }
                        var distance = Math.Sqrt(places[x] * places[x] + places[z] * places[z]);
                        writer.Node(id, (float)places[x], 0.25f, (float)places[z], (float)distance);
                    }
                    writer.EndFrame();
                }
            });
            var size = 0.75 * (new FileInfo(page).Length - Before.Length - After.Length);
            Assert.Less(size / (Nodes * Frames), 4.5, "the bytes per node and frame, before the encoding as base64");
        }

        [Test]
        public void FramesDoNotAllocateInSteadyState()
        {
            using (var writer = new ReplayWriter(scratch, new ReplayMetadata()))
            {
                void Write(int from, int to)
                {
                    for (var time = from; time < to; time++)
                    {
                        writer.BeginFrame(time, 100);
                        for (var id = 0; id < 100; id++) writer.Node(id, id + 0.01f * time, 0, 0, id);
                        for (var id = 1; id < 100; id++) writer.Link(0, id);
                        writer.EndFrame();
                    }
                }
                // Allocations are measured within one segment, because each segment allocates a compressor.
                Write(0, 2 * ReplayWriter.FramesPerSegment + 1);
                var before = GC.GetAllocatedBytesForCurrentThread();
                Write(2 * ReplayWriter.FramesPerSegment + 1, 3 * ReplayWriter.FramesPerSegment - 1);
                Assert.AreEqual(0, GC.GetAllocatedBytesForCurrentThread() - before);
            }
        }

        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        [TestCase(4)]
        [TestCase(5)]
        [TestCase(6)]
        [TestCase(7)]
        [TestCase(8)]
        public void RandomRunsRoundTripWithinQuantisationError(int seed)
        {
            var random = new Random(seed);
            var given = new List<ReplayDecoder.Frame>();
            var replay = Record(writer =>
            {
                var frames = random.Next(1, 70);
                for (var i = 0; i < frames; i++) given.Add(RandomFrame(writer, random, i));
            });
            Assert.AreEqual(given.Count, replay.Frames.Count);
            for (var i = 0; i < given.Count; i++)
            {
                // Scalars are quantised over the range of their segment.
                var segment = given.Skip(i / ReplayWriter.FramesPerSegment * ReplayWriter.FramesPerSegment).Take(ReplayWriter.FramesPerSegment);
                var scalars = segment.SelectMany(frame => frame.Nodes.Values).Select(node => (double)node.Scalar).Where(value => !double.IsNaN(value)).ToList();
                var range = scalars.Count == 0 ? 0 : scalars.Max() - scalars.Min();
                AssertSame(given[i], replay.Frames[i], range / 65534 / 2 + 1e-7 * range);
            }
        }

        [Test]
        public void MetadataIsJsonInTheInvariantCulture()
        {
            var culture = Thread.CurrentThread.CurrentCulture;
            try
            {
                Thread.CurrentThread.CurrentCulture = new CultureInfo("de-DE");
                var metadata = new ReplayMetadata
                {
                    Title = "\"A\\\n<b>", Seed = ulong.MaxValue, DeltaTime = 0.05, NodeRadius = 0.5f, NodeHeight = 1.5f,
                    Fields = new[] { new ReplayField("warmth") { Unit = "°C", Min = -1.5f, Max = 2 } },
                };
                metadata.SetArena(-1, 0, -2.5f, 3, 4, 5);
                metadata.AddBox(1, 2, 3, 4, 5, 6);
                metadata.AddSphere(1.5f, 0, 0, 2);
                metadata.AddCapsule(1, 2, 3, 0.5f, 2, 1, 0, 0, 0, 1);
                metadata.AddMarker("source", 25, 0, 0);
                var replay = Record(writer => Frame(writer, 0), metadata);
                Assert.AreEqual(
                    "{\"title\":\"\\\"A\\\\\\n<b>\",\"seed\":\"18446744073709551615\",\"deltaTime\":0.05,\"nodeRadius\":0.5,\"nodeHeight\":1.5," +
                    "\"arena\":{\"min\":[-1.0,0.0,-2.5],\"max\":[3.0,4.0,5.0]}," +
                    "\"shapes\":[{\"kind\":\"box\",\"size\":[4.0,5.0,6.0],\"centre\":[1.0,2.0,3.0],\"rotation\":[0.0,0.0,0.0,1.0]}," +
                    "{\"kind\":\"sphere\",\"centre\":[1.5,0.0,0.0],\"radius\":2.0}," +
                    "{\"kind\":\"capsule\",\"radius\":0.5,\"height\":2.0,\"axis\":1,\"centre\":[1.0,2.0,3.0],\"rotation\":[0.0,0.0,0.0,1.0]}]," +
                    "\"markers\":[{\"name\":\"source\",\"position\":[25.0,0.0,0.0]}]}",
                    replay.Header["metadata"].ToString(Formatting.None));
                Assert.AreEqual(
                    "[{\"name\":\"warmth\",\"kind\":\"number\",\"unit\":\"°C\",\"min\":-1.5,\"max\":2.0," +
                    "\"least\":0.0,\"greatest\":0.0,\"someWithout\":false}]",
                    replay.Header["fields"].ToString(Formatting.None));
            }
            finally
            {
                Thread.CurrentThread.CurrentCulture = culture;
            }
        }

        [Test]
        public void ValuesOfEachFieldRoundTrip()
        {
            var fields = new[]
            {
                new ReplayField("warmth"), new ReplayField("leader", ReplayFieldKind.Category) { Categories = new[] { "none" } },
                new ReplayField("colour", ReplayFieldKind.Colour),
            };
            var leaders = new double[] { 0, -(1 << 30) + 1, (1 << 30) - 1, 16777217, double.NaN };
            var replay = Record(
                writer =>
                {
                    for (var time = 0; time < 25; time++)
                    {
                        writer.BeginFrame(time);
                        for (var id = 0; id < leaders.Length; id++)
                        {
                            writer.Node(id, 0, 0, 0, 0.5 * id);
                            writer.Value(1, leaders[(id + time) % leaders.Length]);
                            if (id > 0) writer.Value(2, 0x0A0B0C + id);
                        }
                        writer.EndFrame();
                    }
                },
                new ReplayMetadata { Fields = fields });
            for (var time = 0; time < 25; time++)
            {
                for (var id = 0; id < leaders.Length; id++)
                {
                    var values = replay.Frames[time].Nodes[id].Values;
                    Assert.AreEqual(0.5 * id, values[0], 1e-4);
                    Assert.AreEqual(leaders[(id + time) % leaders.Length], values[1]);
                    Assert.AreEqual(id > 0 ? 0x0A0B0C + id : double.NaN, values[2]);
                }
            }
            Assert.AreEqual(
                "{\"name\":\"leader\",\"kind\":\"category\",\"order\":[0,-1073741823,1073741823,16777217],\"words\":[\"none\"],"
                + "\"least\":-1073741823.0,\"greatest\":1073741823.0,\"someWithout\":true}",
                replay.Header["fields"][1].ToString(Formatting.None));
        }

        [Test]
        public void InvalidCategoryValuesAreRejected()
        {
            foreach (var value in new[] { 0.5, 1 << 30, double.NegativeInfinity })
            {
                using (var writer = new ReplayWriter(scratch, new ReplayMetadata { Fields = new[] { new ReplayField("leader", ReplayFieldKind.Category) } }))
                {
                    writer.BeginFrame(0);
                    StringAssert.Contains("Node 7 has ", Assert.Throws<ArgumentException>(() => writer.Node(7, 0, 0, 0, value)).Message);
                }
            }
        }

        [Test]
        public void MetricsAndMovingShapesAreInTheHeader()
        {
            var metadata = new ReplayMetadata { Metrics = new ReplayMetrics(new[] { "found", "links" }) };
            var mover = metadata.AddMovingBox(1, 2, 3);
            var replay = Record(
                writer =>
                {
                    Frame(writer, 0);
                    mover.Add(0.12345f, 0, 0, 0, 0, 0, 1);
                    metadata.Metrics.Add(0, new[] { 0.5, double.NaN });
                },
                metadata);
            Assert.AreEqual(
                "{\"times\":[0.0],\"series\":[{\"name\":\"found\",\"values\":[0.5]},{\"name\":\"links\",\"values\":[null]}]}",
                replay.Header["metrics"].ToString(Formatting.None));
            Assert.AreEqual(
                "[{\"shape\":{\"kind\":\"box\",\"size\":[1.0,2.0,3.0]},\"poses\":[0.123,0.0,0.0,0.0,0.0,0.0,1.0]}]",
                replay.Header["movers"].ToString(Formatting.None));
        }

        [Test]
        public void InvalidFramesAreRejectedWithNodeAndFrame()
        {
            AssertRefused<ArgumentException>("Node 5 is at (NaN, 0, 0) in frame 0", w => w.Node(5, float.NaN, 0, 0, 0));
            AssertRefused<ArgumentException>("Node 5 has an infinite value in frame 0", w => w.Node(5, 0, 0, 0, float.PositiveInfinity));
            AssertRefused<ArgumentException>("Node 1 occurs twice in frame 0", w => w.Node(1, 0, 0, 0, 0));
            AssertRefused<ArgumentException>("Link 1 - 8: node 8 is not in frame 0", w => w.Link(1, 8));
            AssertRefused<ArgumentException>("Node 1 is linked to itself", w => w.Link(1, 1));
            AssertRefused<InvalidOperationException>("BeginFrame: the previous frame has not ended", w => w.BeginFrame(1));
            AssertRefused<InvalidOperationException>("Finish: the last frame has not ended", w => w.Finish(template, page));
            AssertRefused<InvalidOperationException>("EndFrame: no frame has begun", w => { w.EndFrame(); w.EndFrame(); });
            AssertRefused<InvalidOperationException>("Node: no frame has begun", w => { w.EndFrame(); w.Node(2, 0, 0, 0, 0); });
            AssertRefused<InvalidOperationException>("Link: no frame has begun", w => { w.EndFrame(); w.Link(1, 2); });
            AssertRefused<ArgumentException>("Frame 1 of the replay has time 0", w => { w.EndFrame(); w.BeginFrame(0); });
            AssertRefused<ArgumentException>("Frame 1 of the replay has time NaN", w => { w.EndFrame(); w.BeginFrame(double.NaN); });
        }

        [Test]
        public void ANodeOfAnEarlierFrameCannotBeLinked()
        {
            using (var writer = new ReplayWriter(scratch, new ReplayMetadata()))
            {
                Frame(writer, 0, 1, 2);
                writer.BeginFrame(1);
                writer.Node(1, 0, 0, 0, 0);
                StringAssert.Contains("node 2 is not in frame 1", Assert.Throws<ArgumentException>(() => writer.Link(1, 2)).Message);
            }
        }

        [Test]
        public void FinishFailsWithoutFrames()
        {
            using (var writer = new ReplayWriter(scratch, new ReplayMetadata()))
                StringAssert.Contains("the replay has no frames", Assert.Throws<InvalidOperationException>(() => writer.Finish(template, page)).Message);
        }

        [TestCase("no placeholder")]
        [TestCase("@@REPLAY@@ @@REPLAY@@")]
        public void AnInvalidTemplateIsReported(string text)
        {
            File.WriteAllText(template, text);
            using (var writer = new ReplayWriter(scratch, new ReplayMetadata()))
            {
                Frame(writer, 0);
                StringAssert.Contains(template, Assert.Throws<InvalidDataException>(() => writer.Finish(template, page)).Message);
            }
            Assert.IsFalse(File.Exists(page));
        }

        [Test]
        public void InvalidMetadataIsRejected()
        {
            Assert.Throws<ArgumentException>(() => new ReplayMetadata().AddSphere(0, 0, float.NaN, 1));
            Assert.Throws<ArgumentException>(() => new ReplayMetadata().SetArena(0, 0, 0, 0, 0, 0));
            Assert.Throws<ArgumentException>(() => new ReplayWriter(scratch, new ReplayMetadata { NodeRadius = float.PositiveInfinity }));
            Assert.IsFalse(File.Exists(scratch));
        }

        private ReplayDecoder Record(Action<ReplayWriter> run, ReplayMetadata metadata = null)
        {
            using (var writer = new ReplayWriter(scratch, metadata ?? new ReplayMetadata()))
            {
                run(writer);
                writer.Finish(template, page);
            }
            Assert.IsFalse(File.Exists(scratch), "the scratch file must be deleted");
            return new ReplayDecoder(File.ReadAllText(page), Before, After);
        }

        private void AssertRefused<T>(string message, Action<ReplayWriter> act) where T : Exception
        {
            using (var writer = new ReplayWriter(scratch, new ReplayMetadata()))
            {
                writer.BeginFrame(0);
                writer.Node(1, 0, 0, 0, 0);
                StringAssert.Contains(message, Assert.Throws<T>(() => act(writer)).Message);
            }
        }

        private static void Frame(ReplayWriter writer, double time, params int[] ids)
        {
            writer.BeginFrame(time);
            foreach (var id in ids) writer.Node(id, id, 0, 0, id);
            writer.EndFrame();
        }

        private static ReplayDecoder.Frame RandomFrame(ReplayWriter writer, Random random, int index)
        {
            var frame = new ReplayDecoder.Frame { Time = index * 0.1 };
            var extent = Math.Pow(10, random.Next(-3, 6));
            writer.BeginFrame(frame.Time);
            for (var n = random.Next(0, 300); n > 0; n--)
            {
                var id = random.Next(-200, 200) * 1000003;
                if (frame.Nodes.ContainsKey(id)) continue;
                var node = new ReplayDecoder.Node
                {
                    X = Coordinate(random, extent), Y = Coordinate(random, extent), Z = Coordinate(random, extent),
                    Scalar = random.Next(10) == 0 ? float.NaN : Coordinate(random, extent),
                };
                frame.Nodes.Add(id, node);
                writer.Node(id, node.X, node.Y, node.Z, node.Scalar);
            }
            var ids = new List<int>(frame.Nodes.Keys);
            for (var n = ids.Count < 2 ? 0 : random.Next(0, 2000); n > 0; n--)
            {
                int a = ids[random.Next(ids.Count)], b = ids[random.Next(ids.Count)];
                if (a == b) continue;
                frame.Links.Add((a, b));
                writer.Link(a, b);
            }
            writer.EndFrame();
            return frame;
        }

        private static float Coordinate(Random random, double extent) => (float)((random.NextDouble() - 0.5) * extent);

        private static void AssertSame(ReplayDecoder.Frame expected, ReplayDecoder.Frame actual, double scalarTolerance)
        {
            Assert.AreEqual(expected.Time, actual.Time);
            Assert.AreEqual(expected.Nodes.Count, actual.Nodes.Count);
            Assert.IsTrue(expected.Links.SetEquals(actual.Links), "the links must be equal"); // AreEquivalent takes minutes
            var tolerance = Step / 2 + 1e-6;
            foreach (var pair in expected.Nodes)
            {
                var node = actual.Nodes[pair.Key];
                // The tolerance grows with the value, because large floats have a coarse resolution.
                void AssertNear(float expectedValue, float found) => Assert.AreEqual(expectedValue, found, tolerance + Math.Abs(expectedValue) * 1e-7);
                AssertNear(pair.Value.X, node.X);
                AssertNear(pair.Value.Y, node.Y);
                AssertNear(pair.Value.Z, node.Z);
                if (float.IsNaN(pair.Value.Scalar)) Assert.IsNaN(node.Scalar);
                else Assert.AreEqual(pair.Value.Scalar, node.Scalar, scalarTolerance);
            }
        }
    }
}
