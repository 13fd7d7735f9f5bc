using System;
using System.Collections.Generic;
using System.IO;
using System.Text.RegularExpressions;
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
    /// <summary>What the build of a player takes along, and that the player finds it; the scenes are files, as Unity writes them.</summary>
    public sealed class PlayerBuildTests : ProjectFixture
    {
        private const string Manager = "de7f1c418113b5c64bd5634bfb1c00c4";
        private const string Schema = "probe.ProbeSchema";
        private const string Assets = "player/Swarm_Data/StreamingAssets";
        private const string Samples = "Packages/org.collektive.unity/Jvm~/collektive-samples.jar";

        [SetUp]
        public void InstallJvms()
        {
            foreach (var platform in new[] { "linux-x64", "linux-arm64", "win-x64", "mac-arm64", "mac-x64" })
            {
                Write("Packages/org.collektive.unity.jvm." + platform + "/Jvm~/" + platform + "/lib/modules", platform);
                Write("Packages/org.collektive.unity.jvm." + platform + "/package.json", "{}");
            }
            Write(Path.Combine(Project.PackageCache, "unity/Jvm~/collektive-samples.jar"), "samples");
            Write("Library/Collektive/swarm.jar", "swarm");
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
        public void A_player_takes_the_JVMs_of_its_platform_along(BuildTarget target, string architecture, string platforms)
        {
            Select(target, architecture);
            Players.Build(target, Assets, Scene("jars.Array.data[0]", Samples));
            var jvms = Array.ConvertAll(Directory.GetDirectories(Assets + "/Collektive/Packages/org.collektive.unity/Jvm"), Path.GetFileName);
            Array.Sort(jvms, StringComparer.Ordinal);
            Assert.That(string.Join(" ", jvms), Is.EqualTo(platforms));
            Assert.That(Log, Is.Empty);
        }

        [Test]
        public void The_player_finds_what_was_taken_along()
        {
            var outside = "../" + Path.GetFileName(Directory.GetCurrentDirectory()) + ".jar";
            File.WriteAllText(outside, "outside");
            var absolute = Path.GetFullPath("absolute.jar");
            File.WriteAllText(absolute, "absolute");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene(
                "jars.Array.data[0]", Samples, "jars.Array.data[1]", "Library/Collektive/swarm.jar", "jars.Array.data[2]", outside,
                "jars.Array.data[3]", absolute));
            File.Delete(outside);
            File.Delete(absolute);
            EnterPlayer();

            var taken = Loop.DataPath + "/StreamingAssets/Collektive/";
            Assert.That(File.ReadAllText(Installation.PathOf(Samples)), Is.EqualTo("samples"));
            Assert.That(File.ReadAllText(Installation.PathOf("Library/Collektive/swarm.jar")), Is.EqualTo("swarm"));
            Assert.That(File.ReadAllText(Installation.PathOf(outside)), Is.EqualTo("outside"));
            Assert.That(File.ReadAllText(Installation.PathOf(absolute)), Is.EqualTo("absolute"));
            Assert.That(Installation.HostJar, Is.StringStarting(taken));
            Assert.That(File.ReadAllBytes(Installation.HostJar), Is.EqualTo(File.ReadAllBytes(Path.Combine(Root, "jvm-host/host/target/collektive-host.jar"))));
            Assert.That(File.Exists(Installation.LibraryJar), Is.True);
            Assert.That(File.ReadAllText(Installation.Bundled + "/lib/modules"), Is.EqualTo(Installation.Platform));
            Assert.That(Installation.PathOf("mine.jar"), Is.EqualTo(Path.GetFullPath("mine.jar")), "one that came with nothing is where it is");
        }

        [Test]
        public void The_jars_of_Collektive_come_along()
        {
            Write("jars/dsl.jar", "dsl");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene("jars.Array.data[0]", Samples, "runtime", "Collektive", "runtimeJars", "jars"));
            EnterPlayer();
            Assert.That(File.ReadAllText(Path.Combine(Installation.PathOf("jars"), "dsl.jar")), Is.EqualTo("dsl"));
        }

        [Test, Category("Slow"), Category("Mono")]
        public void Programs_that_changed_are_built_first()
        {
            UseKotlin();
            Write("Assets/Swarm/swarm.fbs", BuildTests.Schema);
            Write("Assets/Swarm/Programs/Count.kt", BuildTests.Kotlin);
            Players.Build(BuildTarget.StandaloneLinux64, Assets, Scene("jars.Array.data[0]", "Assets/Swarm/swarm.clkprograms"));
            Assert.That(new FileInfo(Assets + "/Collektive/Assets/Swarm/swarm.clkprograms").Length, Is.GreaterThan(1000), string.Join("\n", Log));

            Write("Assets/Swarm/Programs/Count.kt", BuildTests.Kotlin.Replace("heard.neighbors.size", "heard.neighbours.size"));
            Fails("Assets/Swarm/swarm.clkprograms is older than its sources because the build failed", "jars.Array.data[0]", "Assets/Swarm/swarm.clkprograms");
        }

        [Test]
        public void A_scene_that_could_not_start_fails_the_build()
        {
            Fails("jar missing.jar does not exist: build it with Tools > Collektive > Rebuild Programs", "jars.Array.data[0]", "missing.jar");
            Fails("delta time is 0 s", "jars.Array.data[0]", Samples, "deltaTime", "0");
            Fails("schema 'no.Such' does not exist", "schema", "no.Such");
            Fails("the folder of Collektive's jars, jars, does not exist", "jars.Array.data[0]", Samples, "runtime", "Collektive", "runtimeJars", "jars");
        }

        [Test]
        public void A_platform_without_a_JVM_fails_the_build()
        {
            Directory.Delete("Packages/org.collektive.unity.jvm.win-x64", true);
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(BuildTarget.StandaloneWindows64, Assets, Scene("jars.Array.data[0]", Samples)));
            Assert.That(error.Message, Is.StringStarting("the simulation of Assets/Swarm.unity cannot start in the player: no JVM package is installed"));
            Assert.That(error.Message, Is.StringContaining("install org.collektive.unity.jvm.win-x64, or set Location in the JVM settings to JAVA_HOME"));
            Assert.That(Directory.Exists(Assets), Is.False, "nothing is half done");
        }

        [Test]
        public void A_JVM_for_one_of_two_kinds_of_Mac_is_enough()
        {
            Directory.Delete("Packages/org.collektive.unity.jvm.mac-x64", true);
            Players.Build(BuildTarget.StandaloneOSX, Assets, Scene("jars.Array.data[0]", Samples));
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
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(target, Assets, Scene("jars.Array.data[0]", Samples)));
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
            Fails("players for Linux on ARM64 need the native library in org.collektive.unity.jvm.linux-arm64", "jars.Array.data[0]", Samples);
        }

        [Test]
        public void Scenes_without_a_simulation_need_nothing()
        {
            Directory.Delete("Packages/org.collektive.unity.jvm.linux-x64", true);
            Write("Assets/Menu.unity", "%YAML 1.1\n");
            Players.Build(BuildTarget.StandaloneLinux64, Assets, "Assets/Menu.unity");
            Assert.That(Directory.Exists(Assets), Is.False);
        }

        [Test]
        public void A_build_that_names_no_scenes_is_of_the_open_ones()
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
        public void Samples_become_players(string sample)
        {
            var scene = "Assets/" + sample + ".unity";
            var text = File.ReadAllText(Path.Combine(Root, "unity/Samples~", sample, sample + ".unity"));
            Write(scene, Regex.Replace(text, @"value: \w+\.\w+Schema\n", "value: " + Schema + "\n"));
            Players.Build(BuildTarget.StandaloneLinux64, Assets, scene);
            Assert.That(File.Exists(Assets + "/Collektive/Packages/org.collektive.unity/Jvm/collektive-samples.jar"), Is.True);
        }

        private static void Select(BuildTarget target, string architecture) =>
            EditorUserBuildSettings.SetPlatformSettings(BuildPipeline.GetBuildTargetName(target), "Architecture", architecture);

        private static void Fails(string problem, params string[] settings)
        {
            var error = Assert.Throws<BuildFailedException>(() => Players.Build(BuildTarget.StandaloneLinux64, "failed", Scene(settings)));
            Assert.That(error.Message, Is.StringContaining("Assets/Swarm.unity cannot start in the player: " + problem));
        }

        /// <summary>Writes a scene with a manager that has these settings, as names and values, beside its schema.</summary>
        private static string Scene(params string[] settings)
        {
            if (Array.IndexOf(settings, "schema") < 0) settings = new List<string>(settings) { "schema", Schema }.ToArray();
            var text = "%YAML 1.1\n--- !u!1001 &1\nPrefabInstance:\n  m_Modification:\n    m_Modifications:\n";
            for (var i = 0; i < settings.Length; i += 2)
                text += "    - target: {fileID: 2, guid: " + Manager + ", type: 3}\n      propertyPath: settings." + settings[i]
                    + "\n      value: " + settings[i + 1] + "\n      objectReference: {fileID: 0}\n";
            Write("Assets/Swarm.unity", text + "  m_SourcePrefab: {fileID: 1, guid: " + Manager + ", type: 3}\n");
            return "Assets/Swarm.unity";
        }

        /// <summary>Goes on as the player that was built: elsewhere, without the project and the editor's ways.</summary>
        private static void EnterPlayer()
        {
            Loop.DataPath = Path.GetFullPath("player/Swarm_Data");
            Directory.Delete("Library", true);
            Directory.Delete("Packages", true);
            Installation.ToPhysical = Installation.InPlayer;
        }
    }
}
