using System;
using System.IO;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests that a scene that refers to libraries plays on a real JVM, in a project without a JDK, a compiler or sources.</summary>
    [Category("Mono")]
    public sealed class LibraryPlayTests : ProjectFixture
    {
        private SimulationSettings settings;
        private string path;

        [SetUp]
        public void MakeScene()
        {
            path = Environment.GetEnvironmentVariable("PATH");
            Environment.SetEnvironmentVariable("PATH", "/nowhere");
            Installation.HostJar = TestJvm.HostJar;
            Installation.JavaHome = TestJvm.Home;
            Loop.Start(1);
            var manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            settings = manager.Settings;
            settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            settings.jvm.settings = TestJvm.Settings;
        }

        [TearDown]
        public void StopPlaying()
        {
            Loop.Quit();
            Environment.SetEnvironmentVariable("PATH", path);
        }

        [Test]
        public void The_managers_program_runs()
        {
            settings.defaultProgram = Import("swarm", "COLLEKTIVE_PROBE_JAR").Find("double");
            var node = MakeNode(2);
            Play();
            Assert.That(node.Answer, Is.EqualTo(4));
        }

        [Test]
        public void Nodes_run_programs_of_two_libraries()
        {
            settings.libraries.Add(Import("swarm", "COLLEKTIVE_PROBE_JAR"));
            settings.libraries.Add(Import("other", "COLLEKTIVE_OTHER_JAR"));
            settings.defaultProgram = settings.libraries[0].Find("double");
            var (first, second) = (MakeNode(2), MakeNode(2));
            second.Node.OwnProgram = settings.libraries[1].Find("triple");
            Play();
            Assert.That((first.Answer, second.Answer), Is.EqualTo((4f, 6f)));
        }

        [Test]
        public void A_name_that_a_script_sets_takes_precedence()
        {
            settings.libraries.Add(Import("other", "COLLEKTIVE_OTHER_JAR"));
            settings.defaultProgram = Import("swarm", "COLLEKTIVE_PROBE_JAR").Find("double");
            settings.program = "triple";
            var (first, second) = (MakeNode(2), MakeNode(2));
            second.Node.OwnProgram = settings.libraries[0].Find("triple");
            second.Node.Program = "double";
            Assert.That(second.Node.OwnProgram == null, Is.True);
            Play();
            Assert.That((first.Answer, second.Answer), Is.EqualTo((6f, 4f)));
        }

        [Test]
        public void Programs_of_one_name_in_two_libraries_are_an_error_that_names_both()
        {
            settings.libraries.Add(Import("swarm", "COLLEKTIVE_PROBE_JAR"));
            settings.libraries.Add(Import("copy", "COLLEKTIVE_PROBE_JAR"));
            Play();
            Assert.That(SimulationManager.Current == null, Is.True);
            var error = Logged("two programs are named '");
            Assert.That(error, Is.StringContaining("swarm.clkprograms").And.StringContaining("copy.clkprograms"));
        }

        [Test]
        public void A_program_of_a_library_that_is_not_listed_is_an_error_of_its_node()
        {
            settings.defaultProgram = Import("swarm", "COLLEKTIVE_PROBE_JAR").Find("double");
            var node = MakeNode(2);
            node.Node.name = "Drone";
            // Without this error, the program of the same name in the manager's libraries would run instead.
            node.Node.OwnProgram = Import("copy", "COLLEKTIVE_PROBE_JAR").Find("double");
            Play();
            Logged("node 0 ('Drone'): program 'double' is in Assets/copy.clkprograms, which is not among the libraries of the Simulation Manager");
        }

        [Test]
        public void Libraries_that_cannot_run_together_are_an_error()
        {
            var library = Import("swarm", "COLLEKTIVE_PROBE_JAR");
            Assert.That(settings.FindLibraryProblem(), Is.StringContaining("no program library is selected"));
            settings.libraries.Add(null);
            Assert.That(settings.JarPaths, Is.Empty, "this property must not throw, because builds before Play read it");
            Assert.That(settings.FindLibraryProblem(), Is.StringContaining("is empty, or its file was deleted"));
            settings.libraries[0] = library;
            Assert.That(settings.FindLibraryProblem(), Is.Null);
            ProgramLibraryTests.Pack("Assets/other.clkprograms", "other.OtherSchema");
            settings.libraries.Add(AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/other.clkprograms"));
            Assert.That(settings.FindLibraryProblem(), Is.StringStarting("Assets/swarm.clkprograms and Assets/other.clkprograms were compiled with different "
                + "schemas, probe.ProbeSchema and other.OtherSchema"));
        }

        private static ProgramLibrary Import(string name, string jar)
        {
            Directory.CreateDirectory("Assets");
            File.Copy(TestJvm.Variable(jar), "Assets/" + name + ".clkprograms");
            return AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/" + name + ".clkprograms");
        }

        private static ProbeNode MakeNode(float value)
        {
            var holder = new GameObject("Probe");
            holder.transform.position = new Vector3(Node.All.Count, 0, 0);
            var node = holder.AddComponent<Node>();
            var sensor = holder.AddComponent<ProbeSensor>();
            sensor.Value = value;
            return new ProbeNode(node, sensor, holder.AddComponent<ProbeActuator>());
        }

        private void Play() => Loop.Frame(settings.deltaTime);
    }
}
