using System;
using System.Collections.Generic;
using System.IO;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests the menu Tools &gt; Collektive with the real flatc, generator, javac and Kotlin compiler.</summary>
    [Category("Mono"), Category("AnyPlacement")]
    public sealed class BuildTests : ProjectFixture
    {
        internal const string Schema = "namespace swarm;\ntable SensorData { intensity: float; }\nstruct ActuatorData { hops: float; }\n";

        internal const string Kotlin = @"package swarm

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import org.collektive.api.Program

@Program(""count"")
public fun Aggregate<Int>.count(sensors: SensorData): ActuatorData {
    val heard = neighboring(sensors.intensity())
    return ActuatorData(hops = heard.neighbors.size.toFloat())
}
";

        [Test]
        public void Code_is_generated_beside_its_schema()
        {
            Write("Assets/Swarm/swarm.fbs", Schema);
            Write("Assets/Ignored~/other.fbs", "this is not a schema");
            var refreshes = Project.Refreshes;
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Generate Schema Code");
            Assert.That(File.Exists("Assets/Swarm/Generated/swarm/SwarmSchema.cs"), Is.True, string.Join("\n", Log));
            Assert.That(Project.Refreshes, Is.EqualTo(refreshes + 1));
            Assert.That(Log.FindAll(line => !line.StartsWith("Log: ")), Is.Empty);
        }

        [Test]
        public void A_schema_error_is_logged_with_file_and_line()
        {
            Write("Assets/Swarm/swarm.fbs", Schema.Replace("intensity: float", "intensity: flaot"));
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Generate Schema Code");
            var error = Logged("flaot");
            Assert.That(error, Is.StringStarting("Error: Assets/Swarm/swarm.fbs(2)"));
            Assert.That(error, Is.StringContaining("<a href=\"Assets/Swarm/swarm.fbs\" line=\"2\">"));
        }

        [Test]
        public void An_error_without_a_position_is_logged_unchanged()
        {
            Write("Assets/swarm.fbs", "namespace swarm;\ntable SensorData { intensity: float; }\n");
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Generate Schema Code");
            Assert.That(Logged("ActuatorData is missing"), Is.StringStarting("Error: "));
        }

        [Test]
        public void The_Gradle_build_names_the_programs_and_files_of_the_package()
        {
            Write("Assets/Swarm/swarm.fbs", Schema);
            Write("Assets/Swarm/Programs/Count.kt", Kotlin);
            Write("Assets/$Other/other.fbs", Schema);
            Write("Assets/$Other/Programs/Count.kt", Kotlin);
            for (var i = 0; i < 2; i++) EditorApplication.ExecuteMenuItem("Tools/Collektive/Write Gradle Build");
            Assert.That(Logged("open the folder CollektivePrograms"), Is.StringStarting("Log: "));
            Assert.That(Directory.GetFiles("CollektivePrograms").Length, Is.EqualTo(2));
            var text = File.ReadAllText("CollektivePrograms/build.gradle.kts");
            var folder = Directory.GetCurrentDirectory();
            Assert.That(text, Is.StringContaining(
                "files(\"" + folder + "/Assets/\\$Other/Programs\", \"" + folder + "/Assets/Swarm/Programs\")"));
            Assert.That(text, Is.StringContaining("files(\"" + folder + "/Assets/\\$Other/other.fbs\", \"" + folder + "/Assets/Swarm/swarm.fbs\")"));
            var paths = Regex.Matches(text, "\"(/[^\"]+)\"");
            Assert.That(paths.Count, Is.EqualTo(11));
            foreach (Match path in paths)
            {
                var file = path.Groups[1].Value.Replace("\\$", "$");
                Assert.That(File.Exists(file) || Directory.Exists(file), Is.True, file);
            }
        }

        [Test]
        public void Without_programs_no_Gradle_build_is_written()
        {
            Write("Assets/swarm.fbs", Schema);
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Write Gradle Build");
            Assert.That(Logged("no sources were found"), Is.StringStarting("Warning: "));
            Assert.That(Directory.Exists("CollektivePrograms"), Is.False);
        }

        [Test]
        public void Without_schemas_the_menu_logs_where_to_put_them()
        {
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Generate Schema Code");
            Assert.That(Logged("no sources were found. Put schemas (*.fbs) below Assets"), Is.StringStarting("Warning: "));
        }

        [Test]
        public void A_missing_Kotlin_compiler_is_reported_with_the_setting_to_change()
        {
            Write("Assets/swarm.fbs", Schema);
            Write("Assets/Programs/Count.kt", Kotlin);
            var path = Environment.GetEnvironmentVariable("PATH");
            var home = Environment.GetEnvironmentVariable("KOTLIN_HOME");
            Environment.SetEnvironmentVariable("PATH", "/nowhere");
            Environment.SetEnvironmentVariable("KOTLIN_HOME", null);
            try
            {
                EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Programs");
                ProgramBuild.Wait();
            }
            finally
            {
                Environment.SetEnvironmentVariable("PATH", path);
                Environment.SetEnvironmentVariable("KOTLIN_HOME", home);
            }
            Assert.That(Logged("no Kotlin compiler was found"), Is.StringContaining("Preferences > Collektive"));
        }

        [Test]
        public void Empty_and_quoted_entries_of_PATH_are_accepted()
        {
            var path = Environment.GetEnvironmentVariable("PATH");
            UseKotlin("2.0.0");
            var kotlin = PersonalSettings.instance.kotlin;
            PersonalSettings.instance.kotlin = "";
            File.WriteAllText(Path.Combine(Directory.CreateDirectory(Path.Combine(kotlin, "bin")).FullName, "kotlinc"), "");
            Environment.SetEnvironmentVariable("PATH", ":/:\"" + Path.Combine(kotlin, "bin") + "\":");
            try
            {
                Assert.That(Toolchain.FindKotlin(AggregateRuntime.Collektive), Is.EqualTo(kotlin));
            }
            finally
            {
                Environment.SetEnvironmentVariable("PATH", path);
            }
        }

        [Test]
        public void A_Kotlin_compiler_of_another_version_is_refused()
        {
            UseKotlin("1.9.0");
            Assert.Throws<ToolException>(() => Toolchain.FindKotlin(AggregateRuntime.BuiltIn));
        }

        [Test]
        public void Code_is_generated_with_the_bundled_JRE()
        {
            var bundled = Path.Combine(Path.GetFullPath(Project.PackageCache), "unity/Jvm~/linux-x64");
            MakeJre(bundled);
            Write("Assets/Swarm/swarm.fbs", Schema);
            // This java command writes a file that shows that it has run.
            File.Move(bundled + "/bin/java", bundled + "/bin/real");
            File.WriteAllText(bundled + "/bin/java", "#!/bin/sh\necho ran >>ran.txt\nexec '" + bundled + "/bin/real' \"$@\"\n");
            ToolRun.Do("/bin/chmod", "755", bundled + "/bin/java");
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Generate Schema Code");
            Assert.That(File.Exists("Assets/Swarm/Generated/swarm/SwarmSchema.cs"), Is.True, string.Join("\n", Log));
            Assert.That(File.ReadAllText("ran.txt"), Is.EqualTo("ran\n"));
        }

        [Test]
        public void The_JVM_package_of_this_platform_is_found_beside_the_package()
        {
            var home = Path.GetFullPath("Packages/org.collektive.unity.jvm.linux-x64/Jvm~/linux-x64");
            MakeJre(home);
            MakeJre(Path.GetFullPath("Packages/org.collektive.unity.jvm.win-x64/Jvm~/win-x64"));
            Assert.That(Toolchain.FindJava(), Is.EqualTo(home + "/bin/java"));
        }

        [Test]
        public void A_JRE_in_the_project_settings_is_used_but_is_not_a_JDK()
        {
            MakeJre(Path.GetFullPath("jre"));
            PersonalSettings.instance.jdk = Path.GetFullPath("jre");
            Assert.That(Toolchain.FindJava(), Is.EqualTo(Path.GetFullPath("jre/bin/java")));
            Assert.That(Assert.Throws<ToolException>(() => Toolchain.FindJdk()).Message, Is.StringContaining("has no bin/javac"));
        }

        [Test]
        public void A_changed_tool_is_copied_again_even_if_its_file_time_is_older()
        {
            var first = Toolchain.Flatc();
            Assert.That(Toolchain.Flatc(), Is.EqualTo(first));
            var shipped = Project.PackageCache + "/unity/Tools~/linux-x64/flatc";
            File.AppendAllText(shipped, "newer");
            File.SetLastWriteTimeUtc(shipped, new DateTime(1985, 10, 26));
            Assert.That(Toolchain.Flatc(), Is.Not.EqualTo(first));
            Assert.That(File.ReadAllBytes(Toolchain.Flatc()), Is.EqualTo(File.ReadAllBytes(shipped)));
        }

        [Test, Category("Slow"), Category("Repeats")]
        public void Several_editors_can_copy_a_tool_concurrently()
        {
            const int Editors = 3, Rounds = 5;
            var shipped = Project.PackageCache + "/unity/Tools~/linux-x64/flatc";
            var program = Path.Combine(AppDomain.CurrentDomain.BaseDirectory, "Collektive.TwoEditors.exe");
            var mono = System.Diagnostics.Process.GetCurrentProcess().MainModule.FileName;
            var outcomes = new System.Threading.Tasks.Task<(int Code, string Output)>[Editors];
            for (var i = 0; i < Editors; i++)
                outcomes[i] = System.Threading.Tasks.Task.Run(() => ToolRun.Try(".", mono, "--debug", program, Rounds.ToString()));
            for (var round = 0; round < Rounds; round++)
            {
                File.AppendAllText(shipped, "newer");
                File.WriteAllText("round-" + round, "");
                System.Threading.Thread.Sleep(100);
            }
            foreach (var outcome in outcomes) Assert.That(outcome.Result.Code, Is.EqualTo(0), outcome.Result.Output);
            Assert.That(Directory.GetFiles("Library/Collektive/Tools", "*.part"), Is.Empty);
        }

        [Test]
        public void A_package_update_asks_for_an_editor_restart()
        {
            Menus.Load();
            Assert.That(Log, Is.Empty);
            SessionState.SetString("Collektive.Version", "0.0.1");
            Menus.Load();
            Assert.That(Logged("restart the editor"), Is.StringStarting("Warning: Collektive was updated from 0.0.1 to "));
        }

        [Test]
        public void Code_generated_by_another_version_must_be_regenerated()
        {
            var schemas = Schemas.FindAll();
            Assert.That(schemas, Is.Not.Empty);
            Assert.That(schemas.ConvertAll(PackageState.FindProblem), Is.All.Null, "the generated code of the tests must be up to date");
            Assert.That(PackageState.FindProblem(new OldSchema("0.0.9")), Is.EqualTo("the code of schema old.OldSchema was generated by version 0.0.9 of "
                + "Collektive, but the installed version is " + PackageState.Version + ": generate it again with Tools > Collektive > Generate Schema Code"));
            Assert.That(PackageState.FindProblem(new OldSchema("")), Is.StringContaining("generated by an earlier version"));
        }

        private sealed class OldSchema : DataSchema
        {
            internal OldSchema(string version) => GeneratorVersion = version;

            public override string GeneratorVersion { get; }

            public override string Name => "old.OldSchema";

            public override string File => "old";

            public override IReadOnlyList<KeyValuePair<string, ulong>> Types => throw new NotSupportedException();

            public override SensorBuffer CreateSensors() => throw new NotSupportedException();

            public override ActuatorBuffer CreateActuators() => throw new NotSupportedException();
        }

        /// <summary>Creates a folder that looks like a JRE, which is a JVM without a compiler.</summary>
        private static void MakeJre(string folder)
        {
            var jdk = Environment.GetEnvironmentVariable("COLLEKTIVE_TEST_JAVA_HOME");
            Directory.CreateDirectory(folder + "/bin");
            foreach (var part in new[] { "bin/java", "lib", "release" }) ToolRun.Do("/bin/cp", "-rs", Path.GetFullPath(jdk + "/" + part), folder + "/" + part);
        }

        [Test]
        public void An_invalid_JDK_path_is_reported()
        {
            PersonalSettings.instance.jdk = "/nowhere/jdk";
            Assert.That(Assert.Throws<ToolException>(() => Toolchain.FindJdk()).Message, Is.StringContaining("/nowhere/jdk"));
        }

        [Test]
        public void The_backend_needs_a_source_checkout()
        {
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Backend");
            Logged("source checkout");
            PersonalSettings.instance.sourceCheckout = Path.GetFullPath(".");
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Backend");
            Logged("the command collektive is missing");
        }

        [Test]
        public void Rebuild_Backend_runs_the_checkouts_package_command()
        {
            Write("checkout/collektive", "#!/bin/sh\necho packing\necho \"$PWD/out/$1.tgz\"\n");
            ToolRun.Do("/bin/chmod", "755", "checkout/collektive");
            PersonalSettings.instance.sourceCheckout = Path.GetFullPath("checkout");
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Rebuild Backend");
            Logged("built " + Path.GetFullPath("checkout/out/package.tgz"));
        }

        [Test]
        public void Open_Log_reveals_the_log_file()
        {
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Open Log");
            Assert.That(Project.Revealed, Is.EqualTo(Application.consoleLogPath));
        }
    }
}
