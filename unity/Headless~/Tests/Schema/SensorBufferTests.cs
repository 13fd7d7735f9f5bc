using Collektive.Bridge;
using Collektive.FlatBuffers;
using NUnit.Framework;
using org.collektive.schema;
using Blocks = test.blocks;
using Features = test.features;

namespace Collektive.Headless.Tests.Schema
{
    [TestFixture, Category("AnyPlacement")]
    public class SensorBufferTests
    {
        private SensorBuffer<Features.SensorData> tables;
        private SensorBuffer<Blocks.SensorData> structs;
        private FlatBufferBuilder builder;

        [SetUp]
        public void MakeBuffers()
        {
            tables = (SensorBuffer<Features.SensorData>)new Features.FeaturesSchema().CreateSensors();
            structs = (SensorBuffer<Blocks.SensorData>)new Blocks.BlocksSchema().CreateSensors();
            builder = new FlatBufferBuilder(64);
        }

        [Test]
        public void ElementsHaveSchemaDefaultsInitiallyAndAfterClear()
        {
            tables.EnsureCapacity(1);
            var data = tables.Items[0];
            AssertDefaults(data);
            new RandomData(1).Fill(data);
            tables.Clear(0);
            AssertDefaults(data);
        }

        private static void AssertDefaults(Features.SensorData data)
        {
            Assert.That(data.Flag, Is.True);
            Assert.That(data.Number, Is.EqualTo(int.MinValue));
            Assert.That(data.Enormous, Is.EqualTo((ulong)long.MaxValue));
            Assert.That(data.Part, Is.EqualTo(0.1f));
            Assert.That(data.Limit, Is.EqualTo(float.PositiveInfinity));
            Assert.That(data.Mode, Is.EqualTo(Features.Mode.Walk));
            Assert.That(data.MaybeNumber, Is.Null);
            Assert.That(data.Position, Is.Null);
            Assert.That(data.Text, Is.Null);
            Assert.That(data.Points.Count, Is.EqualTo(0));
            Assert.That(data.Leaf, Is.Null);
        }

        [Test]
        public void WrittenTablesReadBack()
        {
            var random = new RandomData(5);
            for (var i = 0; i < 300; i++)
            {
                tables.EnsureCapacity(3);
                for (var k = 0; k < 3; k++) random.Fill(tables.Items[k]);
                builder.Clear();
                var reader = new TableActuatorBuffer<swapped.features.ActuatorData>(new TableShape());
                Attach(reader, tables.Write(builder, 3));
                Assert.That(reader.Count, Is.EqualTo(3));
                for (var k = 0; k < 3; k++) Assert.That(Dump.Of(reader[k]), Is.EqualTo(Dump.Of(tables.Items[k])));
            }
        }

        private void Attach(ActuatorBuffer reader, int offset)
        {
            builder.Finish(offset);
            var frame = builder.SizedByteArray();
            reader.Attach(new ByteBuffer(frame), frame.Length - offset);
        }

        [Test]
        public void StructsOfAllTypesReadBack()
        {
            var random = new RandomData(6);
            structs.EnsureCapacity(4);
            for (var i = 0; i < 4; i++) structs.Items[i] = random.Mirror<Blocks.SensorData>();
            var reader = new StructActuatorBuffer<Blocks.SensorData>();
            Attach(reader, structs.Write(builder, 4));
            Assert.That(reader.Count, Is.EqualTo(4));
            for (var i = 0; i < 4; i++) Assert.That(Dump.Of(reader[i]), Is.EqualTo(Dump.Of(structs.Items[i])));
        }

        [Test]
        public void AnEmptyBufferReadsBackEmpty()
        {
            var reader = new StructActuatorBuffer<Blocks.SensorData>();
            Attach(reader, structs.Write(builder, 0));
            Assert.That(reader.Count, Is.EqualTo(0));
        }

        [Test]
        public void GrowingKeepsElementsAndTheirDrafts()
        {
            tables.EnsureCapacity(1);
            var first = tables.Items[0];
            tables.EnsureCapacity(100);
            Assert.That(tables.Items[0], Is.SameAs(first));
            Assert.That(tables.Items[99], Is.Not.Null);
            tables.EnsureCapacity(1);
            Assert.That(tables.Items.Length, Is.GreaterThanOrEqualTo(100));
        }

        [Test]
        public void FindNotFiniteReturnsThePathOfTheFirstField()
        {
            structs.EnsureCapacity(1);
            Assert.That(structs.FindNotFinite(0), Is.Null);
            structs.Items[0].Inner.Weight = double.NegativeInfinity;
            Assert.That(structs.FindNotFinite(0), Is.EqualTo("inner.weight"));
            structs.Items[0].HomePosition.Y = float.NaN;
            Assert.That(structs.FindNotFinite(0), Is.EqualTo("home_position.y"));
        }

        [TestCase("part")]
        [TestCase("maybe_whole")]
        [TestCase("position.z")]
        [TestCase("parts[1]")]
        [TestCase("points[2].x")]
        [TestCase("main.scores[0]")]
        [TestCase("tree.children[1].leaf.place.y")]
        public void FindNotFiniteSearchesListsAndTables(string path)
        {
            tables.EnsureCapacity(1);
            var data = tables.Items[0];
            data.Position = new Vector3Value(1, 2, path == "position.z" ? float.NaN : 3);
            data.Part = path == "part" ? float.NaN : 1;
            data.MaybeWhole = path == "maybe_whole" ? double.PositiveInfinity : 1;
            data.Parts.Add(1);
            data.Parts.Add(path == "parts[1]" ? float.NaN : 1);
            for (var i = 0; i < 3; i++) data.Points.Add(new Vector3Value(path == "points[2].x" && i == 2 ? float.NaN : 0, 0, 0));
            data.MakeMain().Scores.Add(path == "main.scores[0]" ? double.NaN : 0);
            data.MakeTree().Children.Add();
            data.Tree.Children.Add().MakeLeaf().Place = new Vector2Value(0, path.StartsWith("tree") ? float.NaN : 0);
            Assert.That(tables.FindNotFinite(0), Is.EqualTo(path));
        }

        [Test]
        public void AFieldWithAnInfiniteDefaultCanBeInfinite()
        {
            tables.EnsureCapacity(1);
            Assert.That(tables.Items[0].Limit, Is.EqualTo(float.PositiveInfinity));
            Assert.That(tables.FindNotFinite(0), Is.Null);
        }

        [Test]
        public void AMissingRequiredFieldIsRejectedWithItsNameAndElement()
        {
            tables.EnsureCapacity(2);
            foreach (var data in tables.Items)
            {
                data.Label = "x";
                data.MakeMain().Name = "x";
            }
            tables.Write(builder, 2);
            tables.Items[1].Main.Name = null;
            var error = Assert.Throws<BridgeException>(() => tables.Write(builder, 2));
            Assert.That(error.Error, Is.EqualTo(BridgeError.Argument));
            Assert.That(error.Message, Is.EqualTo(
                "the sensor data of due node number 1: Leaf.name is required by the schema and was not set"));
        }

        [Test]
        public void AnUnpairedSurrogateIsRejected()
        {
            tables.EnsureCapacity(1);
            tables.Items[0].MakeMain().Name = "x";
            foreach (var text in new[] { "x\ud83d", "\ude80x" })
            {
                tables.Items[0].Label = text;
                var error = Assert.Throws<BridgeException>(() => tables.Write(builder, 1));
                Assert.That(error.Message, Is.EqualTo("the sensor data of due node number 0: a text contains an unpaired surrogate"));
            }
        }

        [Test]
        public void ANullInAListOfStringsIsRejected()
        {
            tables.EnsureCapacity(1);
            var data = tables.Items[0];
            data.Label = "x";
            data.MakeMain().Name = "x";
            data.Words.Add("a");
            data.Words.Add(null);
            var error = Assert.Throws<BridgeException>(() => tables.Write(builder, 1));
            Assert.That(error.Message, Is.StringContaining("SensorData.words[1] is null"));
        }

        [Test]
        public void NestedDraftsAreClearedAndReused()
        {
            tables.EnsureCapacity(1);
            var data = tables.Items[0];
            var leaf = data.MakeLeaf();
            leaf.Name = "old";
            Assert.That(data.MakeLeaf(), Is.SameAs(leaf));
            var listed = data.Leaves.Add();
            listed.Name = "old";
            data.Clear();
            Assert.That(data.Leaf, Is.Null);
            Assert.That(data.MakeLeaf(), Is.SameAs(leaf));
            Assert.That(leaf.Name, Is.Null);
            Assert.That(data.Leaves.Add(), Is.SameAs(listed));
            Assert.That(listed.Name, Is.Null);
        }

        [Test]
        public void GlobalDataIsStagedLikeATable()
        {
            var globals = (GlobalBuffer<test.globals.GlobalData>)new test.globals.GlobalsSchema().CreateGlobals();
            Assert.That(globals.Data.Gain, Is.EqualTo(2.5));
            globals.Data.Wind = new Vector3Value(float.NaN, 0, 0);
            Assert.That(globals.FindNotFinite(), Is.EqualTo("wind.x"));
            globals.Data.Zones.Add();
            var error = Assert.Throws<BridgeException>(() => globals.Write(builder));
            Assert.That(error.Message, Is.EqualTo("the global data: Zone.name is required by the schema and was not set"));
            globals.Clear();
            Assert.That(globals.Data.Wind, Is.Null);
            Assert.That(new Blocks.BlocksSchema().CreateGlobals(), Is.Null);
        }
    }
}
