using System;
using System.Collections.Generic;
using System.IO;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>A fixture with a Unity project in a temporary folder, in which the package's tools have the same paths as in the tarball.</summary>
    public abstract class ProjectFixture
    {
        private string before;
        private string folder;

        /// <summary>The log messages, in the form "TYPE: TEXT".</summary>
        protected List<string> Log { get; } = new List<string>();

        protected static string Root => Environment.GetEnvironmentVariable("COLLEKTIVE_ROOT");

        [SetUp]
        public void MakeProject()
        {
            Loop.Reset();
            Log.Clear();
            Application.logMessageReceivedThreaded += Keep;
            before = Directory.GetCurrentDirectory();
            folder = Path.Combine(Path.GetTempPath(), "collektive-editor-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
            Directory.SetCurrentDirectory(folder);
            Unity.Installation.HostJar = null;
            SessionState.EraseString("Collektive.Version");
            EditorApplication.delayCall = EditorApplication.update = null;
            Undo.undoRedoPerformed = null;
            Project.Answer = null;
            Project.CancelsWaiting = false;
            Menus.Load();
            Copy("schema/types.fbs", "Tools~/types.fbs");
            Copy("build/flatc-linux-x64/flatc", "Tools~/linux-x64/flatc");
            Copy("jvm-host/generator/target/collektive-generator.jar", "Tools~/collektive-generator.jar");
            Copy("jvm-host/compiler-plugin/target/compiler-plugin-0.2.0.jar", "Tools~/collektive-compiler-plugin.jar");
            Copy("jvm-host/stdlib/src/main/kotlin/org/collektive/links/Links.kt", "Tools~/Links.kt");
            Copy("jvm-host/testing/target/collektive-testing.jar", "Tools~/collektive-testing.jar");
            Copy("scripts/template/build.gradle.kts", "Tools~/build.gradle.kts");
            foreach (var jar in new[] { "host", "library", "adapter" })
                Copy("jvm-host/host/target/collektive-" + jar + ".jar", "Jvm~/collektive-" + jar + ".jar");
        }

        [TearDown]
        public void RemoveProject()
        {
            Application.logMessageReceivedThreaded -= Keep;
            EditorApplication.isPlaying = false;
            Loop.IsBatchMode = true;
            Unity.Editor.CompilerProcess.Kill();
            Directory.SetCurrentDirectory(before);
            Directory.Delete(folder, true);
        }

        /// <summary>Writes a file of the project.</summary>
        protected static void Write(string path, string text)
        {
            Directory.CreateDirectory(Path.GetDirectoryName(path));
            File.WriteAllText(path, text);
        }

        protected string Logged(string part)
        {
            var found = Log.Find(line => line.Contains(part));
            Assert.That(found, Is.Not.Null, "'" + part + "' was not logged, but: " + string.Join("\n", Log));
            return found;
        }

        /// <summary>Creates a Kotlin compiler with the layout of its distribution and the jars that the build uses.</summary>
        protected static void UseKotlin(string version = "2.4.21-release-1")
        {
            Write("kotlinc/build.txt", version);
            Directory.CreateDirectory("kotlinc/lib");
            foreach (var jar in Directory.GetFiles(Path.Combine(Root, "build/kotlinc"), "*.jar"))
                Unity.Editor.ToolRun.Do("/bin/ln", "-s", jar, Path.Combine("kotlinc/lib", Path.GetFileName(jar)));
            Unity.Editor.PersonalSettings.instance.kotlin = Path.GetFullPath("kotlinc");
        }

        private static void Copy(string built, string packed)
        {
            var target = Path.Combine(Project.PackageCache, "unity", packed);
            Directory.CreateDirectory(Path.GetDirectoryName(target));
            File.Copy(Path.Combine(Root, built), target);
        }

        private void Keep(string message, string stack, LogType type)
        {
            lock (Log) Log.Add(type + ": " + message);
        }
    }
}
