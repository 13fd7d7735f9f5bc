using System.Collections.Generic;
using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>The Gradle build that IDEs use to complete and check a project's Kotlin code. Unity does not use it.</summary>
    internal static class GradleBuild
    {
        /// <summary>Folder of the build in the project. It is outside of <c>Assets</c>, because Unity would import Gradle's outputs there.</summary>
        internal const string Folder = "CollektivePrograms";

        /// <summary>Writes the build of all programs that use the built-in runtime.</summary>
        /// <exception cref="ToolException">A tool of the package is missing.</exception>
        internal static void Write(IReadOnlyList<SchemaProject> projects)
        {
            var schemas = new List<string>();
            var programs = new List<string>();
            foreach (var project in projects)
            {
                schemas.Add(Escape(project.Schema));
                programs.Add(Escape(project.Programs));
            }
            var text = File.ReadAllText(Toolchain.GradleTemplate)
                .Replace("@HOST@", Escape(Installation.HostJar))
                .Replace("@LIBRARY@", Escape(Installation.LibraryJar))
                .Replace("@TESTING@", Escape(Toolchain.Testing))
                .Replace("@PLUGIN@", Escape(Toolchain.CompilerPlugin))
                .Replace("@GENERATOR@", Escape(Toolchain.Generator))
                .Replace("@FLATC@", Escape(Toolchain.Flatc()))
                .Replace("@TYPES@", Escape(Toolchain.SchemaFolder))
                .Replace("@SCHEMAS@", string.Join("\", \"", schemas))
                .Replace("@PROGRAMS@", string.Join("\", \"", programs));
            Directory.CreateDirectory(Folder);
            Write("settings.gradle.kts", "rootProject.name = \"programs\"\n");
            Write("build.gradle.kts", text);
        }

        private static void Write(string name, string text)
        {
            var path = Path.Combine(Folder, name);
            var part = AtomicFile.TemporaryPath(path);
            File.WriteAllText(part, text);
            AtomicFile.Rename(part, path);
        }

        /// <summary>Returns a path in the form of a Kotlin string literal, without quotes.</summary>
        private static string Escape(string path) => Path.GetFullPath(path).Replace('\\', '/').Replace("\"", "\\\"").Replace("$", "\\$");
    }
}
