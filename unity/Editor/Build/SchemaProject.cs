using System;
using System.Collections.Generic;
using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// A user's schema, and what belongs to it by location: the generated C# in <c>Generated</c> beside it, the Kotlin in
    /// <c>Programs</c> beside it, and the jar that is built from both, <c>Library/Collektive/NAME.jar</c>.
    /// </summary>
    internal sealed class SchemaProject
    {
        internal SchemaProject(string schema, ProgramRuntime runtime)
        {
            Schema = schema;
            Runtime = runtime;
        }

        /// <summary>The runtime for which its programs are compiled.</summary>
        internal ProgramRuntime Runtime { get; }

        /// <summary>The schema's path from the project's folder.</summary>
        internal string Schema { get; }

        internal string Name => Path.GetFileNameWithoutExtension(Schema);

        internal string Generated => Path.Combine(Path.GetDirectoryName(Schema), "Generated");

        internal string Programs => Path.Combine(Path.GetDirectoryName(Schema), "Programs");

        /// <summary>The jar, as the manager's settings name it.</summary>
        internal string Jar => Installation.JarOf(Name, Runtime.Kind);

        internal bool HasPrograms => Directory.Exists(Programs) && Directory.GetFiles(Programs, "*.kt", SearchOption.AllDirectories).Length > 0;

        /// <summary>Names the version of the package that built the jar, whose generated code is specific to it, and the runtime of the jar.</summary>
        private string StampFile => Jar + ".version";

        private string Stamp => PackageState.Version + " " + Runtime.ManifestValue;

        /// <summary>Records the package version that built the jar.</summary>
        internal void WriteStamp() => File.WriteAllText(StampFile, Stamp);

        /// <summary>Whether the schema or a program was changed after the jar was made, or another version of the package or runtime made it.</summary>
        internal bool IsStale
        {
            get
            {
                if (!File.Exists(Jar) || !File.Exists(StampFile) || File.ReadAllText(StampFile) != Stamp) return true;
                var made = File.GetLastWriteTimeUtc(Jar);
                if (File.GetLastWriteTimeUtc(Schema) > made) return true;
                foreach (var file in Directory.GetFiles(Programs, "*.kt", SearchOption.AllDirectories))
                {
                    if (File.GetLastWriteTimeUtc(file) > made) return true;
                }
                return false;
            }
        }

        /// <summary>All schemas below <c>Assets</c>, by path, without folders that Unity ignores.</summary>
        internal static List<SchemaProject> FindAll(ProgramRuntime runtime)
        {
            var found = new List<SchemaProject>();
            if (!Directory.Exists("Assets")) return found;
            foreach (var schema in Directory.GetFiles("Assets", "*.fbs", SearchOption.AllDirectories))
            {
                var path = schema.Replace('\\', '/');
                if (!path.Contains("~/") && !path.Contains("/.")) found.Add(new SchemaProject(path, runtime));
            }
            found.Sort((a, b) => string.CompareOrdinal(a.Schema, b.Schema));
            return found;
        }
    }
}
