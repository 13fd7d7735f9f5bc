using System.IO;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEditor.SceneManagement;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests scenes of earlier versions, which refer to their schema, jars and programs by name.</summary>
    [Category("Mono"), Category("AnyPlacement")]
    public sealed class ProgramNamesTests : ProjectFixture
    {
        private SimulationManager manager;

        private SimulationSettings Settings => manager.Settings;

        [SetUp]
        public void MakeLibraries()
        {
            ProgramLibraryTests.Pack("Assets/Swarm/swarm.clkprograms", ("swarm.A", ProgramLibraryTests.Program("hops") + ProgramLibraryTests.Program("flock")));
            ProgramLibraryTests.Pack("Assets/Other/other.clkprograms", "other.OtherSchema");
            manager = new GameObject("Manager").AddComponent<SimulationManager>();
        }

        [TestCase("Library/Collektive/swarm.jar", "")]
        [TestCase("Library/Collektive/swarm-collektive.jar", "probe.ProbeSchema")]
        [TestCase("Packages/org.collektive.unity/Jvm~/collektive-samples.jar", "probe.ProbeSchema")]
        [TestCase("Assets/Swarm/swarm.clkprograms", "probe.ProbeSchema")]
        [TestCase("", "probe.ProbeSchema")]
        public void Names_of_existing_jars_and_programs_become_references(string jar, string schema)
        {
            if (jar.Length > 0) Settings.jars.Add(jar);
            Settings.schema = schema;
            Settings.program = "hops";
            var node = new GameObject("Node").AddComponent<Node>();
            node.Program = "flock";
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);

            var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/Swarm/swarm.clkprograms");
            Assert.That(Settings.libraries, Is.EqualTo(new[] { library }));
            Assert.That(Settings.defaultProgram, Is.SameAs(library.Find("hops")));
            Assert.That(node.OwnProgram, Is.SameAs(library.Find("flock")));
            Assert.That((Settings.jars.Count, Settings.schema, Settings.program), Is.EqualTo((0, "", "")));
            Assert.That(Settings.FindProblem(), Is.Null);
            Logged("Log: 'Manager' now refers to the libraries of its programs: save the scene");
            Assert.That(Log.FindAll(line => line.StartsWith("Warning")), Is.Empty);
        }

        [Test]
        public void A_scene_is_converted_when_it_is_opened()
        {
            var folder = Path.Combine(Root, "unity/Samples~/Channel");
            var scene = File.ReadAllText(Path.Combine(folder, "Channel.unity"));
            // Changes the scene to the form that the previous release wrote.
            var start = scene.IndexOf("      propertyPath: settings.libraries", System.StringComparison.Ordinal);
            var end = scene.IndexOf("      propertyPath: settings.seed", System.StringComparison.Ordinal);
            var target = "    - target: {fileID: 7296416222207784731, guid: de7f1c418113b5c64bd5634bfb1c00c4, type: 3}\n";
            string Change(string field, string value) =>
                "      propertyPath: settings." + field + "\n      value: " + value + "\n      objectReference: {fileID: 0}\n" + target;
            Write("Assets/Channel.unity", scene.Substring(0, start) + Change("jars.Array.size", "1")
                + Change("jars.Array.data[0]", "Packages/org.collektive.unity/Jvm~/collektive-samples.jar") + Change("schema", "channel.ChannelSchema")
                + Change("program", "channel") + scene.Substring(end));
            File.Copy(Path.Combine(Root, "build/generated/sample-programs/channel.clkprograms"), "Assets/channel.clkprograms");
            Object.DestroyImmediate(manager.gameObject);
            EditorSceneManager.OpenScene("Assets/Channel.unity");
            manager = Object.FindAnyObjectByType<SimulationManager>(FindObjectsInactive.Include);
            Assert.That(Settings.defaultProgram, Is.SameAs(AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/channel.clkprograms").Find("channel")));
            Assert.That(Settings.jars, Is.Empty);
        }

        [Test]
        public void Prefabs_that_the_scene_refers_to_are_converted_and_saved()
        {
            Settings.jars.Add("Library/Collektive/swarm.jar");
            var prefab = File.ReadAllText(Path.Combine(Root, "unity/Prefabs/Node.prefab"));
            const string node = "guid: 9c1e09e8ac3777bd27a3ab900fd4df1a, type: 3}\n";
            string Fields(string reference, string name) => prefab.Replace(node, node + "  ownProgram: " + reference + "\n  program: " + name + "\n");
            Write("Assets/Robot.prefab", Fields("{fileID: 0}", "flock"));
            Write("Assets/Unused.prefab", Fields("{fileID: 0}", "flock"));
            var robot = "{fileID: 1, guid: " + AssetDatabase.AssetPathToGUID("Assets/Robot.prefab") + ", type: 3}";
            Write("Assets/Robots.unity", "--- !u!114 &1\nMonoBehaviour:\n  robot: " + robot + "\n");
            EditorSceneManager.OpenScene("Assets/Robots.unity");
            var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/Swarm/swarm.clkprograms");
            AssetDatabase.TryGetGUIDAndLocalFileIdentifier(library.Find("flock"), out var guid, out var id);
            Assert.That(File.ReadAllText("Assets/Robot.prefab"), Is.EqualTo(Fields("{fileID: " + id + ", guid: " + guid + ", type: 3}", "")));
            Assert.That(File.ReadAllText("Assets/Unused.prefab"), Is.StringContaining("program: flock"), "the prefab is not in an open scene");
        }

        [Test]
        public void Scenes_that_are_not_loaded_are_skipped()
        {
            Loop.AddUnloadedScene();
            Settings.program = "hops";
            Settings.jars.Add("Library/Collektive/swarm.jar");
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Assert.That(Settings.program, Is.Empty);
            Assert.That(SceneSimulation.FindAll(null).Count, Is.EqualTo(1));
        }

        [Test]
        public void A_jar_without_a_library_stays_and_is_reported()
        {
            Settings.jars.Add("build/own.jar");
            Settings.program = "hops";
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Assert.That((Settings.jars[0], Settings.program), Is.EqualTo(("build/own.jar", "hops")));
            Assert.That(Settings.libraries, Is.Empty);
            Assert.That(Logged("Warning: 'Manager' names jar build/own.jar, but Assets has no library of programs for it"),
                Is.StringContaining("copy a jar to Assets with the extension .clkprograms"));
        }

        [Test]
        public void A_program_without_a_library_stays_and_is_reported_once()
        {
            Settings.jars.Add("Library/Collektive/swarm.jar");
            Settings.program = "hop";
            foreach (var name in new[] { "First", "Second" }) new GameObject(name).AddComponent<Node>().Program = "flok";
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Assert.That(Settings.program, Is.EqualTo("hop"));
            Assert.That(Settings.libraries, Has.Count.EqualTo(1));
            Logged("Warning: 'Manager' names program 'hop', which none of its libraries contains: select another one");
            Assert.That(Log.FindAll(line => line.Contains("names program 'flok', which no library")), Has.Count.EqualTo(1));
        }

        [Test]
        public void Undo_restores_the_names()
        {
            Settings.jars.Add("Library/Collektive/swarm.jar");
            Settings.program = "hops";
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Project.PerformUndo();
            Assert.That((Settings.jars[0], Settings.program), Is.EqualTo(("Library/Collektive/swarm.jar", "hops")));
            Assert.That(Settings.libraries, Is.Empty);
        }

        [Test]
        public void References_are_not_touched()
        {
            Settings.libraries.Add(AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/Swarm/swarm.clkprograms"));
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Assert.That(Log, Is.Empty);
        }
    }
}
