using System;
using System.IO;
using System.Text;
using Collektive.Bridge;
using Collektive.FlatBuffers;

namespace Collektive.Headless.Tests.Schema
{
    /// <summary>
    /// The C# half of <c>schema/test/test_roundtrip.py</c>. It writes random sensor and global data for the JVM, and compares actuator data that the JVM has
    /// written. The schemas are a comma-separated argument. Each schema has a file of records, which contain sensors, globals (-1 for none), count, frame
    /// and text. See Record.
    /// </summary>
    internal static class RoundTrip
    {
        private static int Main(string[] arguments)
        {
            foreach (var name in arguments[1].Split(','))
            {
                var schema = (DataSchema)Activator.CreateInstance(Type.GetType(name + ", TestSchemas", true));
                var file = arguments[2] + "." + name;
                if (arguments[0] == "write") Write(schema, file, int.Parse(arguments[3]), int.Parse(arguments[4]));
                else Read(schema, file);
            }
            return 0;
        }

        private static void Write(DataSchema schema, string file, int records, int seed)
        {
            var random = new RandomData(seed);
            var sensors = schema.CreateSensors();
            var globals = schema.CreateGlobals();
            var builder = new FlatBufferBuilder(1024);
            using (var output = new BinaryWriter(File.Create(file)))
            {
                foreach (var type in schema.Types) output.Write(type.Value);
                for (var i = 0; i < records; i++)
                {
                    var count = random.Below(6);
                    var text = new StringBuilder();
                    Fill(sensors, random, count, text);
                    builder.Clear();
                    var globalOffset = -1;
                    if (globals != null)
                    {
                        var draft = (Draft)Inner(globals, "Data");
                        random.Fill(draft);
                        text.Append(Dump.Of(draft)).Append('\n');
                        globalOffset = globals.Write(builder);
                    }
                    var sensorOffset = sensors.Write(builder, count);
                    builder.Finish(sensorOffset);
                    var frame = builder.SizedByteArray();
                    Record(output, frame.Length - sensorOffset, globalOffset < 0 ? -1 : frame.Length - globalOffset, count, frame, text.ToString());
                }
            }
        }

        private static void Fill(SensorBuffer sensors, RandomData random, int count, StringBuilder text)
        {
            sensors.EnsureCapacity(count);
            var items = (Array)Inner(sensors, "Items");
            for (var i = 0; i < count; i++)
            {
                sensors.Clear(i);
                if (items.GetValue(i) is Draft draft) random.Fill(draft);
                else items.SetValue(Mirror(random, sensors.DataType), i);
                text.Append(Dump.Of(items.GetValue(i))).Append('\n');
            }
        }

        private static object Inner(object buffer, string field) => buffer.GetType()
            .GetField(field, System.Reflection.BindingFlags.Public | System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Instance)
            .GetValue(buffer);

        private static object Mirror(RandomData random, Type type) => typeof(RandomData)
            .GetMethod(nameof(RandomData.Mirror), System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Instance)
            .MakeGenericMethod(type).Invoke(random, null);

        private static void Record(BinaryWriter output, int sensors, int globals, int count, byte[] frame, string text)
        {
            var utf8 = Encoding.UTF8.GetBytes(text);
            output.Write(sensors);
            output.Write(globals);
            output.Write(count);
            output.Write(frame.Length);
            output.Write(frame);
            output.Write(utf8.Length);
            output.Write(utf8);
        }

        private static string TextOf(int count, Func<int, object> element)
        {
            var text = new StringBuilder();
            for (var i = 0; i < count; i++) text.Append(Dump.Of(element(i))).Append('\n');
            return text.ToString();
        }

        private static void Read(DataSchema schema, string file)
        {
            var actuators = schema.CreateActuators();
            var kept = new AnswerCopy[0];
            int passed = 0, failed = 0;
            using (var input = new BinaryReader(File.OpenRead(file)))
            {
                while (input.BaseStream.Position < input.BaseStream.Length)
                {
                    var position = input.ReadInt32();
                    input.ReadInt32();
                    var count = input.ReadInt32();
                    var bytes = input.ReadBytes(input.ReadInt32());
                    var expected = Encoding.UTF8.GetString(input.ReadBytes(input.ReadInt32()));
                    var again = (byte[])bytes.Clone();
                    actuators.Attach(new ByteBuffer(bytes), position);
                    var text = TextOf(count, actuators.Get);
                    // Retained answers must stay readable after their frame is overwritten, and copies must stay readable for ever.
                    actuators.Retain();
                    Array.Clear(bytes, 0, bytes.Length);
                    actuators.Attach(new ByteBuffer(again), position);
                    var former = TextOf(count, actuators.GetPrevious);
                    if (kept.Length < count) Array.Resize(ref kept, count);
                    for (var i = 0; i < count; i++) actuators.CopyPrevious(i, ref kept[i]);
                    Array.Clear(again, 0, again.Length);
                    actuators.Retain();
                    if (actuators.Count == count && text == expected && former == expected && TextOf(count, i => kept[i].Get()) == expected)
                    {
                        passed++;
                    }
                    else if (failed++ == 0)
                    {
                        Console.Error.WriteLine("record " + passed + " of " + file + "\nexpected " + expected + "\nread     " + text);
                    }
                }
            }
            Console.WriteLine(schema.Name + ": Kotlin to C#: " + passed + " passed, " + failed + " failed");
        }
    }
}
