using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Build;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>
    /// Tests that a build of a player packages the files of its simulations, and that the player finds them. The tests write scenes in Unity's format.
    /// </summary>
    [Category("Mono"), Category("AnyPlacement")]
    public sealed class PlayerBuildTests : ProjectFixture
    {
        private const string Manager = "de7f1c418113b5c64bd5634bfb1c00c4";
        private const string Schema = "probe.ProbeSchema";
        private const string Assets = "player/Swarm_Data/StreamingAssets";
        private const string Library = "Assets/Swarm/swarm.clkprograms";

        [SetUp]
        public void InstallJvms()
        {
            foreach (var platform in new[] { "linux-x64", "linux-arm64", "win-x64", "mac-arm64", "mac-x64" })
            {
                Write("Packages/org.collektive.unity.jvm." + platform + "/Jvm~/" + platform + "/lib/modules", platform);
                Write("Packages/org.collektive.unity.jvm." + platform + "/package.json", "{}");
            }
            ProgramLibraryTests.Pack(Library, Schema);
        }

        [TearDown]
        public void LeavePlayer()
        {
            foreach (var target in new[] { BuildTarget.StandaloneLinux64, BuildTarget.StandaloneWindows64, BuildTarget.StandaloneOSX }) Select(target, "");
            Loop.DataPath = AppDomain.CurrentDomain.BaseDirectory;
            Menus.Load();
        }

        [TestCase(BuildTarget.StandaloneLinux64, "", "linux-x64")]
        [TestCase(BuildTarget.StandaloneLinux64, "x64", "linux-x64")]
        [TestCase(BuildTarget.StandaloneLinux64, "ARM64", "linux-arm64")]
        [TestCase(BuildTarget.StandaloneWindows64, "", "win-x64")]
        [TestCase(BuildTarget.StandaloneWindows64, "x64", "win-x64")]
        [TestCase(BuildTarget.StandaloneOSX, "x64ARM64", "mac-arm64 mac-x64")]
        [TestCase(BuildTarget.StandaloneOSX, "ARM64", "mac-arm64")]
        [TestCase(BuildTarget.StandaloneOSX, "x64", "mac-x64")]
        public void A_player_contains_the_JVMs_of_its_platform(BuildTarget target, string architecture, string platforms)
        {
            Select(target, architecture);
            Players.Build(target, Assets, Scene());
            var jvms = Array.ConvertAll(Directory.GetDirectories(Assets + "/Collektive/Packages/org.collektive.unity/Jvm"), Path.GetFileName);
            Array.Sort(jvms, StringComparer.Ordinal);
            Assert.That(string.Join(" ", jvms), Is.EqualTo(platforms));
            Assert.That(Log, Is.Empty);
        }

        [Test]
        public void The_player_finds_its_packaged_files()
        {
            var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>(Library);
            var content = File.ReadAllBytes(Library);
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene());
            Directory.Delete("Assets", true);
            EnterPlayer();

            var taken = Loop.DataPath + "/StreamingAssets/Collektive/";
            Assert.That(Installation.PathOf(library.File), Is.StringStarting(taken));
            Assert.That(File.ReadAllBytes(Installation.PathOf(library.File)), Is.EqualTo(content));
            Assert.That(Installation.HostJar, Is.StringStarting(taken));
            Assert.That(File.ReadAllBytes(Installation.HostJar), Is.EqualTo(File.ReadAllBytes(Path.Combine(Root, "jvm-host/host/target/collektive-host.jar"))));
            Assert.That(File.Exists(Installation.LibraryJar), Is.True);
            Assert.That(File.ReadAllText(Installation.Bundled + "/lib/modules"), Is.EqualTo(Installation.Platform));
            Assert.That(Installation.PathOf("mine.jar"), Is.EqualTo(Path.GetFullPath("mine.jar")), "a file that was not packaged must keep its path");
        }

        [Test]
        public void Exactly_the_libraries_that_scenes_refer_to_come_along()
        {
            foreach (var name in new[] { "byDefault", "byNode", "byPrefab", "byNothing" })
                ProgramLibraryTests.Pack("Assets/" + name + "/swarm.clkprograms", ("swarm.SwarmKt", ProgramLibraryTests.Program(name)));
            var scene = Scene("defaultProgram", ProgramOf("byDefault"));
            File.AppendAllText(scene, "--- !u!114 &5\nMonoBehaviour:\n  ownProgram: " + ProgramOf("byNode") + "\n");
            Write("Assets/Drone.prefab", "%YAML 1.1\n--- !u!114 &6\nMonoBehaviour:\n  ownProgram: " + ProgramOf("byPrefab") + "\n");
            var drone = AssetDatabase.AssetPathToGUID("Assets/Drone.prefab");
            File.AppendAllText(scene, "--- !u!114 &7\nMonoBehaviour:\n  drone: {fileID: 6, guid: " + drone + ", type: 3}\n");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, scene);

            var expected = new List<string>();
            foreach (var folder in new[] { "Swarm", "byDefault", "byNode", "byPrefab" })
            {
                var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/" + folder + "/swarm.clkprograms");
                expected.Add(Assets + "/Collektive/" + library.NameInPlayer);
            }
            Assert.That(Directory.GetFiles(Assets + "/Collektive/Programs", "*", SearchOption.AllDirectories), Is.EquivalentTo(expected));
        }

        [Test]
        public void Jars_of_earlier_versions_of_a_scene_come_along()
        {
            var outside = "../" + Path.GetFileName(Directory.GetCurrentDirectory()) + ".jar";
            File.WriteAllText(outside, "outside");
            var absolute = Path.GetFullPath("absolute.jar");
            File.WriteAllText(absolute, "absolute");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene("jars.Array.data[0]", outside, "jars.Array.data[1]", absolute, "schema", Schema));
            File.Delete(outside);
            File.Delete(absolute);
            EnterPlayer();
            Assert.That(File.ReadAllText(Installation.PathOf(outside)), Is.EqualTo("outside"));
            Assert.That(File.ReadAllText(Installation.PathOf(absolute)), Is.EqualTo("absolute"));
        }

        [Test]
        public void A_player_contains_the_jars_of_Collektive()
        {
            Write("jars/dsl.jar", "dsl");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene("runtime", "Collektive", "runtimeJars", "jars"));
            EnterPlayer();
            Assert.That(File.ReadAllText(Path.Combine(Installation.PathOf("jars"), "dsl.jar")), Is.EqualTo("dsl"));
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void Changed_programs_are_built_before_the_player()
        {
            UseKotlin();
            Write("Assets/Swarm/swarm.fbs", BuildTests.Schema);
            Write("Assets/Swarm/Programs/Count.kt", BuildTests.Kotlin);
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene("schema", Schema));
            var built = Assets + "/Collektive/" + AssetDatabase.LoadAssetAtPath<ProgramLibrary>(Library).NameInPlayer;
            Assert.That(new FileInfo(built).Length, Is.GreaterThan(1000), string.Join("\n", Log));

            Write("Assets/Swarm/Programs/Count.kt", BuildTests.Kotlin.Replace("heard.neighbors.size", "heard.neighbours.size"));
            Fails(Library + " is older than its sources because the build failed", "schema", Schema);
        }

        [Test]
        public void An_outdated_library_that_only_an_object_refers_to_fails_the_build_if_it_cannot_be_built()
        {
            ProgramLibraryTests.Pack("Assets/Other/other.clkprograms", Schema);
            var scene = Scene();
            File.AppendAllText(scene, "--- !u!114 &5\nMonoBehaviour:\n  spawned: " + LibraryAt("Assets/Other/other.clkprograms") + "\n");
            Write("Assets/Other/other.fbs", BuildTests.Schema);
            Write("Assets/Other/Programs/Count.kt", "fun broken(");
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(BuildTarget.StandaloneLinux64, Assets, scene));
            Assert.That(error.Message, Is.StringContaining("Assets/Other/other.clkprograms is older than its sources because the build failed"));
        }

        [Test]
        public void A_scene_that_cannot_start_fails_the_build()
        {
            Fails("jar missing.jar does not exist: select a library of programs", "jars.Array.data[0]", "missing.jar", "schema", Schema);
            Fails("delta time is 0 s", "deltaTime", "0");
            ProgramLibraryTests.Pack("Assets/Other/other.clkprograms", "no.Such");
            Fails("schema 'no.Such' does not exist", "libraries.Array.data[0]", LibraryAt("Assets/Other/other.clkprograms"));
            Fails("an entry of Libraries in the Simulation Manager is empty", "libraries.Array.data[0]", "{fileID: 0}");
            Fails("the folder of Collektive's jars, jars, does not exist", "runtime", "Collektive", "runtimeJars", "jars");
        }

        [Test]
        public void A_platform_without_a_JVM_fails_the_build()
        {
            Directory.Delete("Packages/org.collektive.unity.jvm.win-x64", true);
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(BuildTarget.StandaloneWindows64, Assets, Scene()));
            Assert.That(error.Message, Is.StringStarting("the simulation of Assets/Swarm.unity cannot start in the player: no JVM package is installed"));
            Assert.That(error.Message, Is.StringContaining("install org.collektive.unity.jvm.win-x64, or set Location in the JVM settings to JAVA_HOME"));
            Assert.That(Directory.Exists(Assets), Is.False, "a failed build must not leave files");
        }

        [Test]
        public void A_JVM_for_one_Mac_architecture_is_enough()
        {
            Directory.Delete("Packages/org.collektive.unity.jvm.mac-x64", true);
            Players.Build(BuildTarget.StandaloneOSX, Assets, Scene());
            Assert.That(Logged("the player has no JVM for mac-x64"), Is.StringEnding("install org.collektive.unity.jvm.mac-x64"));
        }

        [TestCase(BuildTarget.StandaloneWindows64, "ARM64", "StandaloneWindows64 on arm64")]
        [TestCase(BuildTarget.StandaloneWindows, "", "StandaloneWindows")]
        [TestCase(BuildTarget.EmbeddedLinux, "", "EmbeddedLinux")]
        [TestCase(BuildTarget.LinuxHeadlessSimulation, "", "LinuxHeadlessSimulation")]
        [TestCase((BuildTarget)20, "", "20")]
        public void Other_platforms_fail_the_build_with_one_error(BuildTarget target, string architecture, string name)
        {
            Select(target, architecture);
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(target, Assets, Scene()));
            Assert.That(error.Message, Is.StringStarting("the simulation of Assets/Swarm.unity cannot start in the player: Collektive does not support " + name
                + ": select "));
            Assert.That(Directory.Exists(Assets), Is.False);
            Assert.That(Log, Is.Empty);
        }

        [Test]
        public void Linux_on_ARM64_needs_the_library_of_its_package()
        {
            Select(BuildTarget.StandaloneLinux64, "ARM64");
            Directory.Delete("Packages/org.collektive.unity.jvm.linux-arm64", true);
            Fails("players for Linux on ARM64 need the native library in org.collektive.unity.jvm.linux-arm64");
        }

        [Test]
        public void A_player_without_a_simulation_contains_no_JVM()
        {
            Directory.Delete("Packages/org.collektive.unity.jvm.linux-x64", true);
            Write("Assets/Menu.unity", "%YAML 1.1\n");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, "Assets/Menu.unity");
            Assert.That(Directory.Exists(Assets), Is.False);
        }

        [Test]
        public void A_build_without_listed_scenes_uses_the_open_scenes()
        {
            new GameObject("Manager").AddComponent<SimulationManager>().Settings.jars.Add("missing.jar");
            UnityEngine.Object.FindAnyObjectByType<SimulationManager>().Settings.schema = Schema;
            Assert.Throws<BuildFailedException>(() => Players.Build(BuildTarget.StandaloneLinux64, Assets));
        }

        [TestCase("Channel")]
        [TestCase("Crowd")]
        [TestCase("GradientAscent")]
        [TestCase("LeaderElection")]
        [TestCase("Rescue")]
        [TestCase("Swarm")]
        public void Scenes_of_samples_refer_to_their_libraries(string sample)
        {
            var folder = Path.Combine(Root, "unity/Samples~", sample);
            var schema = Path.GetFileNameWithoutExtension(Directory.GetFiles(folder, "*.fbs")[0]);
            // Imports the sample with its library, whose GUID comes from the path in the package.
            Directory.CreateDirectory("Assets/" + sample);
            var library = "Assets/" + sample + "/" + schema + ".clkprograms";
            File.Copy(Path.Combine(Root, "build/generated/sample-programs", schema + ".clkprograms"), library, true);
            using (var hash = MD5.Create())
            {
                var path = Encoding.UTF8.GetBytes("org.collektive.unity/unity/Samples~/" + sample + "/" + schema + ".clkprograms");
                Write(library + ".meta", "guid: " + BitConverter.ToString(hash.ComputeHash(path)).Replace("-", "").ToLowerInvariant() + "\n");
            }
            var scene = "Assets/" + sample + "/" + sample + ".unity";
            File.Copy(Path.Combine(folder, sample + ".unity"), scene);
            var program = AssetDatabase.LoadAssetAtPath<ProgramLibrary>(library).Programs[0];
            var opened = SceneSimulation.FindAll(new[] { scene })[0].Settings;
            Assert.That(opened.defaultProgram, Is.SameAs(program));
            Assert.That(opened.libraries, Is.EqualTo(new[] { program.Library }));
            Assert.That(AssetDatabase.GetDependencies(new[] { scene }, true), Has.Some.EqualTo(library));

            File.Copy(Path.Combine(folder, schema + ".fbs"), "Assets/" + sample + "/" + schema + ".fbs");
            Directory.CreateDirectory("Assets/" + sample + "/Programs");
            var package = program.Library.Schema.Substring(0, program.Library.Schema.IndexOf('.'));
            foreach (var kotlin in Directory.GetFiles(Path.Combine(Root, "jvm-host/programs/src/main/kotlin", package)))
                File.Copy(kotlin, "Assets/" + sample + "/Programs/" + Path.GetFileName(kotlin));
            Assert.That(SchemaProject.FindAll().Find(project => project.Jar == library).IsStale, Is.False, "Play must not need a JDK");
        }

        private static void Select(BuildTarget target, string architecture) =>
            EditorUserBuildSettings.SetPlatformSettings(BuildPipeline.GetBuildTargetName(target), "Architecture", architecture);

        private static void Fails(string problem, params string[] settings)
        {
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(BuildTarget.StandaloneLinux64, "failed", Scene(settings)));
            Assert.That(error.Message, Is.StringContaining("Assets/Swarm.unity cannot start in the player: " + problem));
        }

        /// <summary>Writes a scene with a library and a manager. The settings alternate between names and values or references.</summary>
        private static string Scene(params string[] settings)
        {
            if (Array.IndexOf(settings, "libraries.Array.data[0]") < 0)
                settings = new List<string>(settings) { "libraries.Array.data[0]", LibraryAt(Library) }.ToArray();
            var text = "%YAML 1.1\n--- !u!1001 &1\nPrefabInstance:\n  m_Modification:\n    m_Modifications:\n";
            for (var i = 0; i < settings.Length; i += 2)
            {
                var isReference = settings[i + 1].StartsWith("{", StringComparison.Ordinal);
                text += "    - target: {fileID: 2, guid: " + Manager + ", type: 3}\n      propertyPath: settings." + settings[i]
                    + "\n      value: " + (isReference ? "" : settings[i + 1])
                    + "\n      objectReference: " + (isReference ? settings[i + 1] : "{fileID: 0}") + "\n";
            }
            Write("Assets/Swarm.unity", text + "  m_SourcePrefab: {fileID: 1, guid: " + Manager + ", type: 3}\n");
            return "Assets/Swarm.unity";
        }

        private static string LibraryAt(string path) => Reference(path, AssetDatabase.LoadAssetAtPath<ProgramLibrary>(path));

        private static string ProgramOf(string folder)
        {
            var path = "Assets/" + folder + "/swarm.clkprograms";
            return Reference(path, AssetDatabase.LoadAssetAtPath<ProgramLibrary>(path).Find(folder));
        }

        private static string Reference(string path, UnityEngine.Object asset)
        {
            AssetDatabase.TryGetGUIDAndLocalFileIdentifier(asset, out var guid, out var id);
            return "{fileID: " + id + ", guid: " + guid + ", type: 3}";
        }

        /// <summary>Continues the test as in the built player, which has a different working directory, no project and no paths of the editor.</summary>
        private static void EnterPlayer()
        {
            Loop.DataPath = Path.GetFullPath("player/Swarm_Data");
            Directory.Delete("Library", true);
            Directory.Delete("Packages", true);
            Installation.ToPhysical = Installation.InPlayer;
            Installation.ToAssetPath = null;
        }
    }
}
