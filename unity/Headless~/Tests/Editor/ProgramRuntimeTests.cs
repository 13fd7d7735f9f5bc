using System.IO;
using System.IO.Compression;
using Collektive.Bridge;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>
    /// Tests Tools &gt; Collektive &gt; Rebuild Programs for a scene on Collektive's runtime. The package's own library and compiler plugin stand in for
    /// Collektive's.
    /// </summary>
    [Category("Mono")]
    public sealed class ProgramRuntimeTests : ProjectFixture
    {
        private const string Jar = "Assets/Swarm/swarm.clkprograms";

        private SimulationSettings settings;

        [SetUp]
        public void MakeScene()
        {
            Write("Assets/Swarm/swarm.fbs", BuildTests.Schema);
            Write("Assets/Swarm/Programs/Count.kt", BuildTests.Kotlin);
            Directory.CreateDirectory("collektive");
            File.Copy(Installation.LibraryJar, "collektive/library.jar");
            File.Copy(Installation.PathOf("Packages/org.collektive.unity/Tools~/collektive-compiler-plugin.jar"), "plugin.jar");
            settings = new GameObject("Manager").AddComponent<SimulationManager>().Settings;
            settings.runtime = AggregateRuntime.Collektive;
            settings.runtimeJars = "collektive";
            settings.runtimePlugin = "plugin.jar";
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void Programs_are_built_for_the_runtime_of_the_open_scene()
        {
            UseKotlin();
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Programs");
            ProgramBuild.Wait();
            Assert.That(File.Exists(Jar), Is.True, string.Join("\n", Log));
            using (var jar = ZipFile.OpenRead(Jar))
            using (var manifest = new StreamReader(jar.GetEntry("META-INF/MANIFEST.MF").Open()))
                Assert.That(manifest.ReadToEnd(), Is.StringContaining("Collektive-Runtime: collektive "));

            settings.jars.Add(Jar);
            var first = File.GetLastWriteTimeUtc(Jar);
            Menus.Load();
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Assert.That(File.GetLastWriteTimeUtc(Jar), Is.EqualTo(first), "without a change, the jar must not be built again");
            File.Copy(Path.Combine(Root, "jvm-host/host/target/collektive-adapter.jar"), "collektive/other.jar");
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            var second = File.GetLastWriteTimeUtc(Jar);
            Assert.That(second, Is.GreaterThan(first), "the jar must be built again after a change to the runtime's jars");
            using (var plugin = ZipFile.Open("plugin.jar", ZipArchiveMode.Update)) plugin.CreateEntry("changed");
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            var third = File.GetLastWriteTimeUtc(Jar);
            Assert.That(third, Is.GreaterThan(second), "the jar must be built again after a change to the compiler plugin");
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            Assert.That(File.GetLastWriteTimeUtc(Jar), Is.EqualTo(third), "without a change, the jar must not be built again");
        }

        [Test]
        public void Missing_jars_are_reported_with_the_artifacts_to_install()
        {
            settings.runtimeJars = "nowhere";
            Rebuild();
            Assert.That(Logged("the folder 'nowhere' contains no jars of Collektive"), Is.StringContaining("collektive-dsl-jvm, collektive-stdlib-jvm"));
        }

        [Test, Category("Slow")]
        public void A_missing_plugin_is_reported_with_the_setting_to_change()
        {
            settings.runtimePlugin = "";
            Rebuild();
            Assert.That(Logged("Collektive's compiler plugin"), Is.StringContaining("Runtime Plugin"));
        }

        [Test, Category("Slow")]
        public void A_jar_without_a_compiler_plugin_is_rejected()
        {
            settings.runtimePlugin = "collektive/library.jar";
            Rebuild();
            Assert.That(Logged("is not a plugin of the Kotlin compiler"), Is.StringContaining("library.jar"));
        }

        private static void Rebuild()
        {
            UseKotlin();
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Programs");
            ProgramBuild.Wait();
            Assert.That(File.Exists(Jar), Is.False);
        }
    }
}
