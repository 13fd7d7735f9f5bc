using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.IO.Compression;
using System.Reflection;
using System.Threading;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests that saving programs builds them in the background, with the real flatc, generator and compilers.</summary>
    [Category("Mono")]
    public sealed class ProgramBuildTests : ProjectFixture
    {
        private const string Schema = "Assets/Swarm/swarm.fbs";
        private const string Count = "Assets/Swarm/Programs/Count.kt";
        private const string Jar = "Assets/Swarm/swarm.clkprograms";

        private static readonly string Wrong = BuildTests.Kotlin.Replace("heard.neighbors.size", "heard.neighbours.size");

        [SetUp]
        public void MakeSwarm()
        {
            Write(Schema, BuildTests.Schema);
            Write(Count, BuildTests.Kotlin);
            ProjectSettings.instance.whenProgramsFail = WhenProgramsFail.Ask;
        }

        [Test, Category("Slow")]
        public void Saved_programs_become_a_jar_beside_the_schema_and_again_when_they_change()
        {
            UseKotlin();
            var clock = Stopwatch.StartNew();
            Save(Count);
            Assert.That(File.Exists(Jar), Is.False, "the editor must not wait for the build");
            Build();
            var first = clock.ElapsedMilliseconds;
            Assert.That(Project.Imported, Has.Some.EqualTo(Jar));
            Assert.That(Programs(), Is.EqualTo(new[] { "swarm.CountKt" }));
            Assert.That(File.Exists("Assets/Swarm/Generated/swarm/SwarmSchema.cs"), Is.True, "the C# must be generated, too");
            Assert.That(Swarm().IsStale, Is.False);
            Assert.That(Project.ProgressItems[Project.ProgressItems.Count - 1], Is.EqualTo((Schema, Progress.Status.Succeeded)));
            Assert.That(Log, Is.Empty);

            // Equal sources must give equal bytes, so that commits do not contain needless changes.
            var bytes = File.ReadAllBytes(Jar);
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Programs");
            Build();
            Assert.That(File.ReadAllBytes(Jar), Is.EqualTo(bytes));

            Write("Assets/Swarm/Programs/More.kt", BuildTests.Kotlin.Replace("count", "more"));
            clock.Restart();
            Save("Assets/Swarm/Programs/More.kt");
            Build();
            Console.WriteLine("the first build took " + first + " ms, a later one " + clock.ElapsedMilliseconds + " ms");
            Assert.That(clock.ElapsedMilliseconds, Is.LessThan(first), "a later build must be faster, because the compilers are already loaded");
            Assert.That(Programs(), Is.EqualTo(new[] { "swarm.CountKt", "swarm.MoreKt" }));

            File.Delete("Assets/Swarm/Programs/More.kt");
            Menus.Postprocess(new string[0], new[] { "Assets/Swarm/Programs/More.kt" });
            Build();
            Assert.That(Programs(), Is.EqualTo(new[] { "swarm.CountKt" }), "the program of a deleted file must be removed");

            Write(Schema, BuildTests.Schema.Replace("hops: float", "hops: float; colour: float"));
            Write(Count, BuildTests.Kotlin.Replace("toFloat()", "toFloat(), colour = 1f"));
            var refreshes = Project.Refreshes;
            Save(Schema);
            Build();
            Assert.That(Swarm().IsStale, Is.False);
            Assert.That(Project.Refreshes, Is.EqualTo(refreshes + 1), "Unity must compile the changed C#");
            Assert.That(File.ReadAllText("Assets/Swarm/Generated/swarm/ActuatorData.cs"), Is.StringContaining("olour"));
            Assert.That(Log, Is.Empty);

            File.AppendAllText(Count, "\n");
            Save(Count);
            Menus.Tick();
            Assert.That(ProgramBuild.IsRunning, Is.True);
            File.Delete(Count);
            Build();
            Assert.That(Programs(), Is.EqualTo(new[] { "swarm.CountKt" }), "a file that is deleted during the build must not empty the jar");
            Assert.That(Project.ProgressItems[Project.ProgressItems.Count - 1], Is.EqualTo((Schema, Progress.Status.Canceled)));
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void An_error_is_in_the_console_when_the_file_is_saved_and_not_again_at_each_reload()
        {
            UseKotlin();
            Write(Count, Wrong);
            Save(Count);
            Build();
            var error = Logged("neighbours");
            Assert.That(error, Is.StringStarting("Error: " + Count + "(10,"));
            Assert.That(error, Is.StringContaining("\n    return ActuatorData(hops = heard.neighbours.size.toFloat())\n"), "the line of the source");
            Assert.That(error, Is.StringContaining("<a href=\"" + Count + "\" line=\"10\">"));
            Assert.That(File.Exists(Jar), Is.False);
            Log.Clear();
            Menus.Postprocess(new string[0], new string[0]);
            Build();
            Assert.That(Log, Is.Empty);

            Write(Count, BuildTests.Kotlin);
            Save(Count);
            // The file changes while the build runs.
            Menus.Tick();
            Write(Count, Wrong);
            Build();
            Logged("neighbours");
            Assert.That(Swarm().IsStale, Is.True);
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void A_build_that_the_user_or_a_reload_of_code_interrupts_leaves_the_old_jar()
        {
            UseKotlin();
            Save(Count);
            Menus.Tick();
            Assert.That(ProgramBuild.IsRunning, Is.True);
            Progress.Cancel(Project.ProgressItems.Count - 1);
            Build();
            Assert.That(File.Exists(Jar), Is.False);
            Assert.That(Project.ProgressItems[Project.ProgressItems.Count - 1].Status, Is.EqualTo(Progress.Status.Canceled));
            Assert.That(Log, Is.Empty);

            // Simulates a domain reload. The new domain can find the build only in the session state, and must finish it.
            SessionState.SetString("Collektive.Build", Jar);
            Menus.Postprocess(new string[0], new string[0]);
            Build();
            Assert.That(Swarm().IsStale, Is.False);
            var compiler = SessionState.GetString("Collektive.Compiler", "");
            var started = typeof(CompilerProcess).GetField("started", BindingFlags.Static | BindingFlags.NonPublic);
            ((IDisposable)started.GetValue(null)).Dispose();
            started.SetValue(null, null);
            Write(Count, BuildTests.Kotlin.Replace("count", "counted"));
            Save(Count);
            Build();
            Assert.That(Swarm().IsStale, Is.False);
            Assert.That(SessionState.GetString("Collektive.Compiler", ""), Is.EqualTo(compiler), "the compiler's process must outlive the reload");

            Write(Jar, "half a jar");
            Assert.That(Swarm().IsStale, Is.True, "a damaged jar must be outdated");
            Menus.Postprocess(new string[0], new string[0]);
            Assert.That(ProgramBuild.IsRunning, Is.False, "without new sources, no build may start");
            Save(Count);
            Build();
            Assert.That(Swarm().IsStale, Is.False);
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void Play_waits_for_the_build_of_every_loaded_scene()
        {
            UseKotlin();
            Write("Assets/Other/other.fbs", BuildTests.Schema.Replace("swarm", "other"));
            Write("Assets/Other/Programs/Count.kt", BuildTests.Kotlin.Replace("swarm", "other"));
            MakeManager(Jar);
            MakeManager("Assets/Other/other.clkprograms");
            Assert.That(Play(), Is.True);
            Assert.That(SchemaProject.FindAll().TrueForAll(project => !project.IsStale), Is.True, string.Join("\n", Log));

            var first = File.GetLastWriteTimeUtc(Jar);
            Assert.That(Play(), Is.True);
            Assert.That(File.GetLastWriteTimeUtc(Jar), Is.EqualTo(first), "without a change, the jar must not be built again");

            // In a clone, the files have different times and, on Windows, different line endings.
            Write(Count, BuildTests.Kotlin.Replace("\n", "\r\n"));
            File.SetLastWriteTimeUtc(Count, DateTime.UtcNow.AddDays(1));
            Assert.That(Swarm().IsStale, Is.False);

            Write("Assets/Other/Programs/Count.kt", "package other\n\nfun broken(");
            Project.Answer = message => !message.Contains("Assets/Other/other.fbs");
            Assert.That(Play(), Is.False);
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void After_a_failed_build_Play_starts_with_the_previous_programs_only_if_the_user_wants_it()
        {
            UseKotlin();
            MakeManager(Jar);
            Assert.That(Play(), Is.True, string.Join("\n", Log));
            Write(Count, Wrong);

            ProjectSettings.instance.whenProgramsFail = WhenProgramsFail.Never;
            Assert.That(Play(), Is.False);
            Assert.That(Logged("Play was not started"), Is.StringStarting("Error: "));

            ProjectSettings.instance.whenProgramsFail = WhenProgramsFail.Always;
            Assert.That(Play(), Is.True);
            Assert.That(Logged(Jar + " is older than its sources"), Is.StringStarting("Warning: "));

            ProjectSettings.instance.whenProgramsFail = WhenProgramsFail.Ask;
            Assert.That(Play(), Is.False, "in batch mode, Play must not start, because no dialog can be shown");
            Loop.IsBatchMode = false;
            foreach (var answer in new[] { false, true })
            {
                var asked = "";
                Project.Answer = message =>
                {
                    asked = message;
                    return answer;
                };
                Assert.That(Play(), Is.EqualTo(answer));
                Assert.That(asked, Is.StringContaining("The programs of " + Schema + " were not compiled"));
            }
            // Cancelling the wait must not start Play.
            Project.CancelsWaiting = true;
            Project.Answer = message => false;
            Assert.That(Play(), Is.False);
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void A_failed_build_of_an_inactive_managers_programs_prevents_Play()
        {
            UseKotlin();
            Write(Count, Wrong);
            MakeManager(Jar).gameObject.SetActive(false);
            ProjectSettings.instance.whenProgramsFail = WhenProgramsFail.Never;
            Assert.That(Play(), Is.False, "a script can activate the manager");
            Logged("Play was not started");
        }

        [TestCase(false), TestCase(true), Category("Slow"), Category("Repeats")]
        public void Without_Kotlin_files_the_jar_of_another_build_or_project_is_kept(bool isBuiltByUnity)
        {
            UseKotlin();
            if (isBuiltByUnity) Commit(Swarm());
            else ProgramLibraryTests.Pack(Jar, "swarm.SwarmSchema");
            File.Delete(Count);
            var bytes = File.ReadAllBytes(Jar);
            MakeManager(Jar);
            Save(Schema);
            Build();
            Assert.That(Play(), Is.True);
            Assert.That(File.ReadAllBytes(Jar), Is.EqualTo(bytes));
        }

        [Test]
        public void Without_a_JDK_saving_logs_one_error_and_a_jar_of_a_colleague_plays()
        {
            PersonalSettings.instance.jdk = "/nowhere/jdk";
            Write("Assets/Other/other.fbs", BuildTests.Schema);
            Write("Assets/Other/Programs/Count.kt", BuildTests.Kotlin);
            Save(Count, "Assets/Other/Programs/Count.kt");
            Build();
            Assert.That(Log, Has.Count.EqualTo(1));
            Assert.That(Logged("the JDK in the preferences, /nowhere/jdk"), Is.StringStarting("Error: "));

            Log.Clear();
            Commit(Swarm());
            new GameObject("Manager").AddComponent<SimulationManager>().Settings.libraries.Add(AssetDatabase.LoadAssetAtPath<ProgramLibrary>(Jar));
            Assert.That(Play(), Is.True);
            Assert.That(Log, Is.Empty);
        }

        [Test]
        public void The_hash_covers_included_schemas_and_the_programs_by_name()
        {
            var seen = new HashSet<string> { Swarm().Sources };
            Write("Assets/Swarm/shapes/box.fbs", "namespace swarm;\nstruct Box { size: float; }\n");
            Write(Schema, "include/* box */\"shapes/box.fbs\";\ninclude \"types.fbs\";\n" + BuildTests.Schema);
            Assert.That(seen.Add(Swarm().Sources), Is.True);
            Write("Assets/Swarm/shapes/box.fbs", "namespace swarm;\nstruct Box { size: double; }\n");
            Assert.That(seen.Add(Swarm().Sources), Is.True);
            Write("Assets/Swarm/Programs/deep/Empty.kt", "");
            Assert.That(seen.Add(Swarm().Sources), Is.True);
            File.Move("Assets/Swarm/Programs/deep/Empty.kt", "Assets/Swarm/Programs/Empty.kt");
            Assert.That(seen.Add(Swarm().Sources), Is.True);
        }

        [Test]
        public void Schemas_that_no_simulation_uses_are_left_alone()
        {
            File.Delete(Count);
            Save(Schema);
            Build();
            ProgramLibraryTests.Pack("Assets/Other/other.clkprograms", "other.OtherSchema");
            new GameObject("Manager").AddComponent<SimulationManager>().Settings.libraries.Add(
                AssetDatabase.LoadAssetAtPath<ProgramLibrary>("Assets/Other/other.clkprograms"));
            Write(Count, BuildTests.Kotlin);
            Assert.That(Play(), Is.True);
            Assert.That(Log, Is.Empty);
        }

        private static SchemaProject Swarm() => SchemaProject.FindAll().Find(project => project.Schema == Schema);

        private static void Save(params string[] files) => Menus.Postprocess(files, new string[0]);

        /// <summary>Runs the loop of the editor until all builds have ended.</summary>
        private static void Build()
        {
            do
            {
                Menus.Tick();
                Thread.Sleep(1);
            }
            while (ProgramBuild.IsRunning);
        }

        private static SimulationManager MakeManager(string jar)
        {
            var manager = new GameObject("Manager").AddComponent<SimulationManager>();
            manager.Settings.jars.Add(jar);
            return manager;
        }

        /// <summary>Presses Play in the editor. Returns whether play mode starts.</summary>
        private static bool Play()
        {
            Menus.Load();
            EditorApplication.isPlaying = true;
            Menus.ChangePlayMode(PlayModeStateChange.ExitingEditMode);
            var starts = EditorApplication.isPlaying;
            EditorApplication.isPlaying = false;
            return starts;
        }

        /// <summary>Writes the jar as if a colleague's editor had built it.</summary>
        private static void Commit(SchemaProject project)
        {
            ProgramLibraryTests.Pack(project.Jar, "Manifest-Version: 1.0\r\nCollektive-Runtime: builtIn\r\nCollektive-Version: " + PackageState.Version
                + "\r\nCollektive-Sources: " + project.Sources.Insert(40, "\r\n ") + "\r\n", "swarm.SwarmSchema");
        }

        /// <summary>Returns the classes with programs in the jar, from the index that the compiler plugin wrote.</summary>
        private static List<string> Programs()
        {
            var classes = new List<string>();
            using (var archive = new ZipArchive(File.OpenRead(Jar)))
            {
                foreach (var entry in archive.Entries)
                {
                    if (entry.FullName.StartsWith("META-INF/collektive/programs/")) classes.Add(entry.Name);
                }
            }
            return classes;
        }
    }
}
