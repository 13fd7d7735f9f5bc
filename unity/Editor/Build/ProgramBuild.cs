using System.Collections.Generic;
using System.IO;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Builds the jar of a schema's Kotlin programs.</summary>
    internal static class ProgramBuild
    {
        /// <summary>The exit code of the Kotlin compiler after an exception in the compiler or in a plugin.</summary>
        private const int CompilerCrashed = 2;

        /// <summary>Rebuilds the jars in the settings that are older than their programs in the project.</summary>
        /// <returns>The jars that could not be built; the errors are logged.</returns>
        internal static List<string> Refresh(SimulationSettings settings)
        {
            var failed = new List<string>();
            // The start of the simulation reports errors of the schema.
            var schema = settings.jars.Count > 0 ? null : Schemas.TryFind(settings.schema);
            var jars = schema != null ? settings.JarsFor(schema) : settings.jars;
            foreach (var project in SchemaProject.FindAll(new ProgramRuntime(settings)))
            {
                // An imported sample has sources too, but runs from the package's own jar.
                if (!jars.Contains(project.Jar) || !project.HasPrograms || !project.IsStale) continue;
                if (!ToolsMenu.TryRun(() => Make(project))) failed.Add(project.Jar);
            }
            return failed;
        }

        /// <returns>Whether the jar was built. Otherwise the errors are logged, and the jar is unchanged.</returns>
        internal static bool Make(SchemaProject project)
        {
            var jdk = Toolchain.FindJdk();
            var kotlin = Toolchain.FindKotlin(project.Runtime.Kind);
            var work = AtomicFile.TemporaryPath(Path.GetFullPath(project.Jar));
            var generated = Path.Combine(work, "generated");
            var classes = Path.Combine(work, "classes");
            Directory.CreateDirectory(classes);
            try
            {
                return SchemaCode.MakeJvm(project, generated)
                    && CompileJava(jdk, generated, classes)
                    && CompileKotlin(jdk, kotlin, classes, generated, project)
                    && Pack(jdk, generated, classes, work, project);
            }
            finally
            {
                Directory.Delete(work, true);
            }
        }

        private static bool CompileJava(string jdk, string generated, string classes)
        {
            var arguments = new List<string> { "--release", "17", "-nowarn", "-proc:none", "-cp", Installation.HostJar, "-d", classes };
            arguments.AddRange(Directory.GetFiles(generated, "*.java", SearchOption.AllDirectories));
            return Run("javac", Path.Combine(jdk, "bin/javac"), arguments);
        }

        private static bool CompileKotlin(string jdk, string kotlin, string classes, string generated, SchemaProject project)
        {
            var path = new List<string> { Installation.HostJar };
            path.AddRange(project.Runtime.Library);
            path.Add(classes);
            var arguments = new List<string>
            {
                "-Xmx1g", "-XX:+UseSerialGC", "-cp", Path.Combine(kotlin, "lib/*"), "org.jetbrains.kotlin.cli.jvm.K2JVMCompiler",
                "-no-stdlib", "-no-reflect", "-jvm-target", "17", "-cp", string.Join(Path.PathSeparator.ToString(), path), "-d", classes, generated,
                Path.GetFullPath(project.Programs),
            };
            arguments.AddRange(project.Runtime.Arguments());
            return Run("the Kotlin compiler", Toolchain.Command(jdk, "java"), arguments);
        }

        private static bool Pack(string jdk, string generated, string classes, string work, SchemaProject project)
        {
            var part = Path.Combine(work, "programs.jar");
            var mark = Path.Combine(work, "mark");
            File.WriteAllText(mark, "Collektive-Runtime: " + project.Runtime.ManifestValue + "\n");
            // The schema's service entry and binary form are in the folder of the generated code.
            if (!Run("jar", Path.Combine(jdk, "bin/jar"), new List<string>
                { "--create", "--file", part, "--manifest", mark, "-C", generated, "META-INF", "-C", classes, "." }))
                return false;
            AtomicFile.Rename(part, project.Jar);
            project.WriteStamp();
            return true;
        }

        private static bool Run(string name, string program, List<string> arguments)
        {
            var (code, output) = ToolRun.Try(".", program, arguments.ToArray());
            ToolConsole.Show(name, code, output);
            if (code == CompilerCrashed)
                Debug.LogError(name + " crashed: the compiler plugin may be built for another version of the compiler; use the plugin's version");
            return code == 0;
        }
    }
}
