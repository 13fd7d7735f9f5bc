using System;
using Collektive.Bridge;
using Collektive.FlatBuffers;
using NUnit.Framework;
using org.collektive.schema;
using Blocks = test.blocks;
using Features = test.features;

namespace Collektive.Headless.Tests.Schema
{
    /// <summary>
    /// Tests that no managed memory is allocated per tick once capacities are reached. The control needs mono-sgen, because Boehm's counter is always 0.
    /// </summary>
    [TestFixture]
    public class AllocationTests
    {
        private const int Nodes = 10;
        private const int Ticks = 4000;

        private readonly FlatBufferBuilder builder = new FlatBufferBuilder(1 << 20);
        private object kept;

        [Test]
        public void TheCounterDetectsAllocations()
        {
            // The control allocates an object of the smallest size in each tick. The limit is lower than its size, because the runtime counts whole blocks.
            Assert.That(AllocatedBy(() => kept = new object()), Is.GreaterThan(8L * Ticks));
        }

        [Test]
        public void StructsAreStagedAndReadWithoutAllocation()
        {
            var sensors = (SensorBuffer<Blocks.SensorData>)new Blocks.BlocksSchema().CreateSensors();
            var reader = new StructActuatorBuffer<Blocks.SensorData>();
            var sum = 0f;
            Assert.That(AllocatedBy(() =>
            {
                sensors.EnsureCapacity(Nodes);
                for (var i = 0; i < Nodes; i++)
                {
                    sensors.Clear(i);
                    sensors.Items[i].HomePosition = new Vector3Value(i, 0, 0);
                    sensors.FindNotFinite(i);
                }
                builder.Clear();
                var offset = sensors.Write(builder, Nodes);
                reader.Attach(builder.DataBuffer, builder.DataBuffer.Length - offset);
                for (var i = 0; i < reader.Count; i++) sum += reader[i].HomePosition.X;
            }), Is.EqualTo(0));
            Assert.That(sum, Is.GreaterThan(0));
        }

        [Test]
        public void TablesAreStagedAndReadWithoutAllocation()
        {
            var sensors = (SensorBuffer<Features.SensorData>)new Features.FeaturesSchema().CreateSensors();
            var reader = new TableActuatorBuffer<swapped.features.ActuatorData>(new TableShape());
            var sum = 0L;
            Assert.That(AllocatedBy(() =>
            {
                sensors.EnsureCapacity(Nodes);
                for (var i = 0; i < Nodes; i++) Sense(sensors, i);
                builder.Clear();
                var offset = sensors.Write(builder, Nodes);
                reader.Attach(builder.DataBuffer, builder.DataBuffer.Length - offset);
                for (var i = 0; i < reader.Count; i++) sum += reader[i].PointsLength;
            }), Is.EqualTo(0));
            Assert.That(sum, Is.GreaterThan(0));
        }

        [Test]
        public void AnswersAreRetainedAndCopiedWithoutAllocation()
        {
            var writer = new TableSensorBuffer<swapped.features.SensorData, swapped.features.SensorData.Row>();
            writer.EnsureCapacity(Nodes);
            for (var i = 0; i < Nodes; i++) new RandomData(i).Fill(writer.Items[i]);
            var table = new Features.FeaturesSchema().CreateActuators();
            var structs = new StructActuatorBuffer<Blocks.SensorData>();
            var blocks = new StructSensorBuffer<Blocks.SensorData>(8);
            blocks.EnsureCapacity(Nodes);
            Assert.That(AllocationOfCopying(table, writer), Is.EqualTo(0));
            Assert.That(AllocationOfCopying(structs, blocks), Is.EqualTo(0));
        }

        private long AllocationOfCopying(ActuatorBuffer reader, SensorBuffer writer)
        {
            builder.Clear();
            var offset = writer.Write(builder, Nodes);
            builder.Finish(offset);
            var frame = builder.DataBuffer;
            var kept = new AnswerCopy[Nodes];
            reader.Attach(frame, frame.Length - offset);
            return AllocatedBy(() =>
            {
                reader.Retain();
                reader.Attach(frame, frame.Length - offset);
                for (var i = 0; i < Nodes; i++) reader.CopyPrevious(i, ref kept[i]);
            });
        }

        private static void Sense(SensorBuffer<Features.SensorData> sensors, int index)
        {
            sensors.Clear(index);
            var data = sensors.Items[index];
            data.Label = "node";
            data.Text = "\u00e9t\u00e9";
            data.MaybeNumber = index;
            data.Position = new Vector3Value(index, 0, 0);
            for (var i = 0; i < index % 5; i++) data.Points.Add(new Vector3Value(i, 0, 0));
            data.Bools.Add(true);
            data.Words.Add("a");
            data.Modes.Add(Features.Mode.Walk);
            data.MakeMain().Name = "main";
            data.Main.Scores.Add(1);
            data.Leaves.Add().Name = "leaf";
            data.MakeTree().Children.Add().MakeLeaf().Name = "deep";
            sensors.FindNotFinite(index);
        }

        [Test]
        public void GlobalDataIsStagedWithoutAllocation()
        {
            var globals = (GlobalBuffer<test.globals.GlobalData>)new test.globals.GlobalsSchema().CreateGlobals();
            Assert.That(AllocatedBy(() =>
            {
                globals.Clear();
                globals.Data.Title = "title";
                var zone = globals.Data.Zones.Add();
                zone.Name = "zone";
                globals.FindNotFinite();
                builder.Clear();
                globals.Write(builder);
            }), Is.EqualTo(0));
        }

        private static long AllocatedBy(Action tick)
        {
            for (var i = 0; i < Ticks; i++) tick();
            var before = GC.GetAllocatedBytesForCurrentThread();
            for (var i = 0; i < Ticks; i++) tick();
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }
    }
}
