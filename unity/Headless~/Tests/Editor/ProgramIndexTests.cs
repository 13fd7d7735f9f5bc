using System.IO;
using System.IO.Compression;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Programs and their parameters are offered before the first Play.</summary>
    public sealed class ProgramIndexTests : ProjectFixture
    {
        private const string Jar = "Library/swarm.jar";

        private const string Hops =
            "program\thops\tprobe.SensorData\nparameter\tbright\t90\tIntensity of a source.\nparameter\tpath\tC:\\\\temp\\tx\t\n";

        private SimulationManager manager;

        [SetUp]
        public void MakeManager()
        {
            Gui.Clear();
            manager = new GameObject("Manager").AddComponent<SimulationManager>();
            manager.Settings.schema = "probe.ProbeSchema";
            manager.Settings.jars.Add(Jar);
        }

        [Test]
        public void The_manager_offers_the_programs_of_its_schema_by_name()
        {
            Pack(("swarm.HopsKt", Hops), ("swarm.OtherKt", "program\telect\tother.SensorData\n"), ("swarm.FlockKt", "program\tflock\tprobe.SensorData\n"));
            manager.Settings.program = "hops";
            Inspect(manager);
            Assert.That(Gui.Lines, Has.Some.EqualTo("popup Choose program: (none) | flock | hops: hops"));
            Gui.Act("Choose program", 1);
            Inspect(manager);
            Assert.That(manager.Settings.program, Is.EqualTo("flock"));
            Gui.Act("Choose program", 0);
            Inspect(manager);
            Assert.That(manager.Settings.program, Is.Empty);
        }

        [Test]
        public void An_unknown_name_is_an_error_with_the_names_that_there_are()
        {
            Pack(("swarm.HopsKt", Hops));
            manager.Settings.program = "hop";
            Inspect(manager);
            Assert.That(Gui.Lines, Has.Some.EqualTo("popup Choose program: (none) | hops | hop (unknown): hop (unknown)"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("help Error: No program is named 'hop'. There is: hops"));
        }

        [Test]
        public void Without_an_index_any_name_may_be_right()
        {
            Pack();
            manager.Settings.program = "hop";
            Inspect(manager);
            Assert.That(Gui.Lines, Has.None.StringStarting("popup").And.None.StringStarting("help Error"));
            Assert.That(Gui.Lines, Has.Some.Contains("has no list of programs"));
            File.Delete(Jar);
            Inspect(manager);
            Assert.That(Gui.Lines, Has.Some.Contains("does not exist yet: press Play, or choose Tools > Collektive > Rebuild Programs"));
        }

        [Test]
        public void A_jar_that_changes_is_read_again()
        {
            Pack(("swarm.HopsKt", Hops));
            Inspect(manager);
            Pack(("swarm.FlockKt", "program\tflock\tprobe.SensorData\n"));
            File.SetLastWriteTimeUtc(Jar, File.GetLastWriteTimeUtc(Jar).AddSeconds(1));
            Gui.Clear();
            Inspect(manager);
            Assert.That(Gui.Lines, Has.Some.EqualTo("popup Choose program: (none) | flock: (none)"));
        }

        [Test]
        public void The_index_of_a_class_that_is_gone_does_not_count()
        {
            Pack(("swarm.HopsKt", Hops), ("-swarm.GoneKt", "program\tgone\tprobe.SensorData\n"));
            Assert.That(ProgramIndex.Of(manager.Settings).Names, Is.EqualTo(new[] { "hops" }));
        }

        [Test]
        public void Jars_that_the_command_makes_have_an_index()
        {
            manager.Settings.jars[0] = TestJvm.Variable("COLLEKTIVE_PROBE_JAR");
            Assert.That(ProgramIndex.Of(manager.Settings).Names, Has.Some.EqualTo("double"));
            Assert.That(ProgramIndex.Of(manager.Settings).WithoutIndex, Is.Null);
        }

        [Test]
        public void A_file_that_is_no_jar_has_no_index()
        {
            Write(Jar, "half a jar");
            Assert.That(ProgramIndex.Of(manager.Settings).WithoutIndex, Is.EqualTo(Path.GetFullPath(Jar)));
        }

        [Test]
        public void A_node_offers_programs_and_the_parameters_of_its_program()
        {
            Pack(("swarm.HopsKt", Hops), ("swarm.FlockKt", "program\tflock\tprobe.SensorData\n"));
            manager.Settings.program = "hops";
            var node = new GameObject("Node").AddComponent<Node>();
            Inspect(node);
            Assert.That(Gui.Lines, Has.Some.EqualTo("popup Choose program: (the manager's) | flock | hops: (the manager's)"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("text bright: 90"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("text path: C:\\temp\tx"));

            Gui.Act("bright", "80");
            Inspect(node);
            Assert.That(node.Parameters, Is.EqualTo(new[] { new NodeParameter("bright", "80") }));
            Gui.Clear();
            Gui.Act("bright", "90");
            Inspect(node);
            Assert.That(Gui.Lines, Has.Some.EqualTo("text bright: 80"));
            Assert.That(node.Parameters, Is.Empty, "the default needs no value");

            Gui.Act("Choose program", 1);
            Inspect(node);
            Assert.That(node.Program, Is.EqualTo("flock"));
        }

        [Test]
        public void A_value_without_a_parameter_is_an_error()
        {
            Pack(("swarm.HopsKt", Hops));
            var node = new GameObject("Node").AddComponent<Node>();
            node.Program = "hops";
            node.Parameters.Add(new NodeParameter("brigth", "80"));
            Inspect(node);
            Assert.That(Gui.Lines, Has.Some.EqualTo("help Error: Program 'hops' has no parameter 'brigth'. Its parameters: bright, path"));
        }

        private static void Inspect(Object target) => UnityEditor.Editor.CreateEditor(target).OnInspectorGUI();

        /// <summary>Makes the jar of classes with their indexes; a class whose name begins with a hyphen has an index alone.</summary>
        private static void Pack(params (string ClassName, string Index)[] classes)
        {
            Directory.CreateDirectory("Library");
            using (var jar = new ZipArchive(File.Create(Jar), ZipArchiveMode.Create))
            {
                jar.CreateEntry("META-INF/MANIFEST.MF");
                foreach (var (className, index) in classes)
                {
                    var name = className.TrimStart('-');
                    if (name == className) jar.CreateEntry(name.Replace('.', '/') + ".class");
                    using (var writer = new StreamWriter(jar.CreateEntry("META-INF/collektive/programs/" + name).Open())) writer.Write(index);
                }
            }
        }
    }
}
