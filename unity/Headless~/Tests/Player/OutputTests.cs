using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Text;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Player
{
    /// <summary>Tests live runs, recordings and tables of runs.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class OutputTests : SimulationFixture
    {
        private const int LimitMs = 20000;

        // A live run ends its process when its connection is closed.
        private static readonly List<Socket> OpenSockets = new List<Socket>();

        private readonly string folder = Path.Combine(Path.GetTempPath(), "collektive-output-" + Guid.NewGuid());

        [SetUp]
        public void MakeFolder() => Directory.CreateDirectory(folder);

        [TearDown]
        public void RemoveFolder() => Directory.Delete(folder, true);

        [Test]
        public void Nodes_that_are_added_or_removed_during_a_pause_are_shown()
        {
            MakeNode(1, default, 7);
            PlayLive(
                (null, (message, frame) => (int?)message["tick"] > 0),
                ("{\"run\": false}", (message, frame) => (bool?)message["running"] == false),
                ("{\"add\": 2, \"at\": [0, 0, 0]}", (message, frame) => Count(frame) == 3),
                ("{\"remove\": 7}", (message, frame) => Count(frame) == 2));
        }

        [Test]
        public void A_live_run_whose_manager_was_disabled_is_stopped()
        {
            MakeNode(1, default, 7);
            Manager.Ticked += manager => manager.enabled = manager.Tick < 2;
            PlayLive((null, (message, frame) => ((string)message["message"])?.Contains("disabled or destroyed the Simulation Manager") == true));
        }

        [Test]
        public void Recordings_contain_nodes_far_from_the_origin_and_categories_of_any_size()
        {
            MakeNode(1, new Vector3(500000, 0, 5000000));
            MakeNode(1, new Vector3(500050, 0, 5000020));
            var header = Record(recorder => recorder.Add(0));
            var arena = header["metadata"]["arena"].ToString(Formatting.None);
            Assert.That(arena, Is.EqualTo("{\"min\":[500000.0,0.0,5000000.0],\"max\":[500050.0,0.0,5000020.0]}"));
            Assert.That((double)header["positionStep"], Is.LessThan(0.01));
            Assert.That((bool)header["fields"][0]["someWithout"], Is.True);
            Assert.That((int)header["fields"][0]["greatest"], Is.EqualTo(1));
        }

        [Test]
        public void Recordings_contain_colliders_as_physics_uses_them()
        {
            MakeNode(1);
            var post = new GameObject("Post").AddComponent<SphereCollider>();
            post.transform.localScale = new Vector3(1, -6, 2);
            new GameObject("Off").AddComponent<BoxCollider>().enabled = false;
            var door = new GameObject("Door").AddComponent<BoxCollider>();
            door.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            door.center = new Vector3(0.5f, 0, 0);
            door.size = new Vector3(1, 2, 0.1f);
            door.transform.localScale = new Vector3(-4, 1, 1);
            var header = Record(recorder =>
            {
                recorder.Record(0);
                door.transform.rotation = Quaternion.Euler(0, 90, 0);
                recorder.Record(1);
                door.enabled = false;
                recorder.Record(2);
                UnityEngine.Object.DestroyImmediate(door.gameObject);
                recorder.Record(3);
            });
            var shapes = header["metadata"]["shapes"].ToString(Formatting.None);
            Assert.That(shapes, Is.EqualTo("[{\"kind\":\"sphere\",\"centre\":[0.0,0.0,0.0],\"radius\":3.0}]"));
            Assert.That(header["movers"][0]["shape"].ToString(Formatting.None), Is.EqualTo("{\"kind\":\"box\",\"size\":[4.0,2.0,0.1]}"));
            var poses = header["movers"][0]["poses"].Values<double>().ToArray();
            Assert.That(poses.Take(7), Is.EqualTo(new[] { -2, 0, 0, 0, 0, 0, 1.0 }).Within(0.001));
            Assert.That(poses.Skip(7).Take(7), Is.EqualTo(new[] { 0, 0, 2, 0, 0.707, 0, 0.707 }).Within(0.001));
            Assert.That(poses.Skip(14), Is.EqualTo(new double[14]));
        }

        [TestCase(0, 0, 0)]
        [TestCase(0, 20, 1)]
        [TestCase(9, 0, 1)]
        public void Only_a_level_box_below_all_nodes_is_the_floor(float tilt, float x, int shapes)
        {
            MakeNode(1, new Vector3(0, 6, 0));
            MakeNode(1, new Vector3(x, 6, 0));
            var house = new GameObject("House").AddComponent<BoxCollider>();
            house.size = new Vector3(10, 5, 8);
            house.transform.rotation = Quaternion.Euler(0, 0, tilt);
            Assert.That(Record(recorder => recorder.Record(0))["metadata"]["shapes"].Count(), Is.EqualTo(shapes));
        }

        [Test]
        public void A_plane_below_all_nodes_is_the_floor()
        {
            MakeNode(1, new Vector3(0, 0.5f, 0));
            GameObject.CreatePrimitive(PrimitiveType.Plane).transform.localScale = new Vector3(2, 1, 2);
            var metadata = Record(recorder => recorder.Record(0))["metadata"];
            Assert.That(metadata["shapes"].Count(), Is.EqualTo(0));
            Assert.That((float)metadata["arena"]["max"][0], Is.EqualTo(10));
        }

        [Test]
        public void Recordings_contain_moving_meshes()
        {
            MakeNode(1);
            var rock = new GameObject("Rock").AddComponent<MeshCollider>();
            rock.convex = true;
            var corners = new[] { Vector3.zero, Vector3.right, Vector3.up, Vector3.forward };
            rock.sharedMesh = new Mesh { vertices = corners, triangles = new[] { 0, 1, 2, 0, 2, 3 } };
            rock.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            rock.transform.localScale = new Vector3(2, 1, 1);
            var shape = Record(recorder => recorder.Record(0))["movers"][0]["shape"];
            Assert.That((string)shape["kind"], Is.EqualTo("mesh"));
            Assert.That((float)shape["vertices"][3], Is.EqualTo(2));
        }

        [Test]
        public void Recordings_contain_the_colour_of_a_node_with_the_id_of_one_that_left()
        {
            void MakeRed()
            {
                var node = MakeNode(1, default, 7).Node;
                var renderer = node.gameObject.AddComponent<MeshRenderer>();
                node.gameObject.AddComponent<ColourOf>().Target = renderer;
                var block = new MaterialPropertyBlock();
                block.SetColor("_Color", Color.red);
                renderer.SetPropertyBlock(block);
            }
            MakeRed();
            var header = Record(recorder =>
            {
                recorder.Record(0);
                UnityEngine.Object.DestroyImmediate(Manager.Find(7).gameObject);
                MakeRed();
                recorder.Record(1);
            });
            Assert.That((string)header["fields"][1]["kind"], Is.EqualTo("colour"));
            Assert.That((bool)header["fields"][1]["someWithout"], Is.False);
        }

        [Test]
        public void A_colour_that_is_not_a_number_is_a_missing_value()
        {
            var node = MakeNode(1, default, 7).Node;
            var renderer = node.gameObject.AddComponent<MeshRenderer>();
            node.gameObject.AddComponent<ColourOf>().Target = renderer;
            var block = new MaterialPropertyBlock();
            block.SetColor("_Color", new Color(1, 0, float.NaN));
            renderer.SetPropertyBlock(block);
            var header = Record(recorder => recorder.Record(0));
            Assert.That((bool)header["fields"][1]["someWithout"], Is.True);
        }

        [Test]
        public void Optional_answers_are_columns_and_colourings()
        {
            Manager.Settings.schema = "test.features.FeaturesSchema";
            using (var table = new NodesTable(Path.Combine(folder, "nodes.csv"), new[] { "maybe_speed", "maybe_mode", "x_y", "xy" }, Manager))
            {
                Assert.That(
                    table.Types.ToString(Formatting.None),
                    Is.EqualTo("{\"maybe_speed\":\"float64\",\"maybe_mode\":\"string\",\"x_y\":\"float64\",\"xy\":\"int64\"}"));
            }
            Assert.That(AnswerColourings.Of(Manager).ConvertAll(colouring => colouring.Name), Has.Member("maybeSpeed").And.Member("maybeMode"));
        }

        [Test]
        public void Colourings_have_different_names()
        {
            var error = Assert.Throws<ScenarioException>(() => Record<TwinScene>(recorder => { }));
            Assert.That(error.Message, Is.StringContaining("two colourings are named 'distance': rename one"));
        }

        [Test]
        public void Categories_may_be_null()
        {
            var header = Record<NamelessScene>(recorder => recorder.Record(0));
            Assert.That((string)header["fields"][0]["kind"], Is.EqualTo("category"));
        }

        [Test]
        public void Sets_of_flags_are_categories()
        {
            Assert.That(AnswerColourings.NamesOf(typeof(test.features.Flags)), Is.EqualTo(new[] { "0", "Red", "Green", "Red, Green" }));
            var convert = AnswerColourings.Converter(typeof(test.features.Flags));
            Assert.That(convert(test.features.Flags.Red | test.features.Flags.Green), Is.EqualTo(3));
        }

        [Test]
        public void A_field_is_a_column_only_once()
        {
            var fields = new[] { "maybe_speed", "position", "maybeSpeed" };
            var error = Assert.Throws<ScenarioException>(() => NodesTable.Check(Schemas.Find("test.features.FeaturesSchema"), fields));
            Assert.That(error.Message, Is.StringContaining("contains a field twice: maybe_speed, maybeSpeed"));
        }

        [Test]
        public void Cells_distinguish_negative_zero()
        {
            MakeNode(1, new Vector3(-0f, 0, 0.1f), 7);
            var file = Path.Combine(folder, "nodes.csv");
            using (var table = new NodesTable(file, new[] { "position" }, Manager)) table.Add(0);
            Assert.That(File.ReadAllText(file), Is.EqualTo("second,node,position.x,position.y,position.z\n0,7,-0,0,0.1\n"));
        }

        [TestCase(double.MaxValue, "1.7976931348623157E+308")]
        [TestCase(0.1, "0.1")]
        [TestCase(7.8486013961250904, "7.8486013961250904")]
        [TestCase(0.36735725187107793, "0.36735725187107793")]
        [TestCase(0.84551240822557006, "0.84551240822557006")]
        [TestCase(0.59081342936996994, "0.59081342936997")]
        public void Numbers_are_written_exactly(double number, string text)
        {
            Assert.That(CsvText.Number(number), Is.EqualTo(text));
            Assert.That((double)JsonFile.Parse(JsonFile.Text(new JValue(number))), Is.EqualTo(number));
        }

        [Test]
        public void Parameters_have_the_values_with_which_nodes_joined()
        {
            Configure("scaled");
            var parameters = new ParameterValues(Manager);
            Manager.Simulation.NodeJoined = parameters.Add;
            var first = MakeNode(1, id: 3);
            Play(1);
            first.Node.Parameters.Add(new NodeParameter("factor", "7"));
            var later = MakeNode(1, id: 1);
            later.Node.Parameters.Add(new NodeParameter("factor", "5"));
            Play(1);
            later.Node.enabled = false;
            Play(1);
            Assert.That(first.Answer, Is.EqualTo(3));
            Assert.That(parameters.ToJson().ToString(Formatting.None), Is.EqualTo("{\"scaled\":{\"factor\":[\"3\",\"5\"]}}"));
        }

        [Test]
        public void A_program_that_a_script_selects_during_the_run_has_no_nodes()
        {
            Configure("scaled");
            var parameters = new ParameterValues(Manager);
            Manager.Simulation.NodeJoined = parameters.Add;
            MakeNode(1);
            Play(1);
            Manager.Settings.program = "double";
            Manager.Simulation.SetParameter("scaled", "factor", "7");
            var later = MakeNode(1);
            Play(1);
            Assert.That(later.Answer, Is.EqualTo(7));
            Assert.That(parameters.ToJson().ToString(Formatting.None), Is.EqualTo("{\"scaled\":{\"factor\":[\"3\",\"7\"]}}"));
        }

        [Test]
        public void A_live_run_reports_invalid_commands()
        {
            MakeNode(1);
            (string, Func<JObject, byte[], bool>) Refused(string command, string reason) =>
                (command, (message, _) => (string)message["event"] == "warning" && ((string)message["message"]).Contains(reason));
            PlayLive(
                (null, (message, _) => (string)message["event"] == "frame"), Refused("{\"speed\":\"NaN\"}", "not a finite number"),
                Refused("{\"add\":1,\"at\":[1e39,0,0]}", "not a finite number"),
                Refused("{\"run\"", "invalid"));
        }

        /// <summary>Plays a live run. Sends each command, and waits for a message that answers it. The first command can be null.</summary>
        private void PlayLive(params (string Command, Func<JObject, byte[], bool> IsAnswer)[] steps)
        {
            var listener = new TcpListener(IPAddress.Loopback, 0);
            listener.Start();
            var test = new Socket(AddressFamily.InterNetwork, SocketType.Stream, ProtocolType.Tcp);
            test.Connect(listener.LocalEndpoint);
            var player = listener.AcceptSocket();
            listener.Stop();
            OpenSockets.AddRange(new[] { test, player });
            var clock = Stopwatch.StartNew();
            var step = 0;
            bool IsEnded()
            {
                Assert.That(clock.ElapsedMilliseconds, Is.LessThan(LimitMs), "step " + step);
                while (test.Available > 0 && step < steps.Length)
                {
                    var message = Receive(test, BitConverter.ToInt32(Receive(test, 4), 0));
                    var end = Array.IndexOf(message, (byte)0);
                    if (!steps[step].IsAnswer(JObject.Parse(Encoding.UTF8.GetString(message, 0, end)), message.Skip(end + 1).ToArray())) continue;
                    if (++step < steps.Length) test.Send(Encoding.UTF8.GetBytes(steps[step].Command + "\n"));
                }
                return step == steps.Length;
            }
            var (scenario, scene, runMetrics) = Prepare<LeaderScene>();
            using (var metrics = new MetricsTable(null, runMetrics, Manager))
            {
                var run = new LiveRun(scenario, scene, runMetrics, metrics, Manager, new LiveChannel((int)player.Handle));
                run.Play(() => Loop.Frame(Manager.Settings.deltaTime), IsEnded);
            }
            // The run may have ended by itself before the last message was read.
            while (!IsEnded())
            {
            }
        }

        /// <summary>Returns the header of a recording of these frames.</summary>
        private JObject Record(Action<ReplayRecorder> addFrames) => Record<LeaderScene>(addFrames);

        private JObject Record<TScene>(Action<ReplayRecorder> addFrames) where TScene : SceneBuilder
        {
            var (scenario, scene, metrics) = Prepare<TScene>();
            ReplayWriter writer = null;
            using (var recorder = new ReplayRecorder(
                scenario, scene, metrics, Manager, metadata => writer = new ReplayWriter(metadata, (bytes, count) => { })))
            {
                addFrames(recorder);
            }
            return writer.Header();
        }

        private (Scenario Scenario, SceneBuilder Scene, RunMetrics Metrics) Prepare<TScene>() where TScene : SceneBuilder
        {
            var path = Path.Combine(folder, "scenario.json");
            File.WriteAllText(path, "{\"version\": 1, \"scene\": \"Scene\", \"scripts\": \".\", \"schema\": \"scenario.json\", \"programs\": \".\", "
                + "\"program\": \"double\", \"seconds\": 1}");
            var scenario = Scenario.Read(path, null, false);
            var scene = new GameObject("Scene").AddComponent<TScene>();
            return (scenario, scene, new RunMetrics(scene, scenario.MakeMetrics(), scenario.Functions));
        }

        private static byte[] Receive(Socket socket, int count)
        {
            var bytes = new byte[count];
            for (var read = 0; read < count;) read += socket.Receive(bytes, read, count - read, SocketFlags.None);
            return bytes;
        }

        /// <summary>Returns the number of nodes in a segment with up to eight slots. FORMAT.md describes it.</summary>
        private static int Count(byte[] segment)
        {
            var count = 0;
            if (segment.Length > 0)
                for (int present = segment[segment[0] + 2]; present > 0; present >>= 1) count += present & 1;
            return count;
        }

        private sealed class ColourOf : MonoBehaviour, IColours
        {
            public Renderer Target { get; set; }
        }

        /// <summary>A scene whose two colourings have the same name.</summary>
        public sealed class TwinScene : SceneBuilder
        {
            public override IReadOnlyList<NodeColouring> Colourings =>
                new[] { new NodeColouring("distance", node => 1), new NodeColouring("distance", node => 2) };

            protected override void Build(SimulationManager manager)
            {
            }
        }

        /// <summary>A scene that colours nodes by a category without names.</summary>
        public sealed class NamelessScene : SceneBuilder
        {
            public override IReadOnlyList<NodeColouring> Colourings =>
                new[] { new NodeColouring("group", node => 1) { IsCategory = true, Categories = null } };

            protected override void Build(SimulationManager manager)
            {
            }
        }

        /// <summary>A scene that colours nodes by a category. Node 0 has no leader.</summary>
        public sealed class LeaderScene : SceneBuilder
        {
            public override IReadOnlyList<NodeColouring> Colourings => new[]
            {
                new NodeColouring("leader", node => node.Id == 0 ? int.MaxValue : node.Id) { IsCategory = true },
            };

            protected override void Build(SimulationManager manager)
            {
            }
        }
    }
}
