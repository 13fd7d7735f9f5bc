using System;
using System.Collections.Generic;
using System.IO;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// A user's schema and the files beside it: the generated C# in <c>Generated</c>, the Kotlin in <c>Programs</c>, and the jar that is built from schema and
    /// Kotlin, <c>NAME.clkprograms</c>.
    /// </summary>
    internal sealed class SchemaProject
    {
        private SchemaProject(string schema, IReadOnlyList<SimulationSettings> simulations)
        {
            Schema = schema;
            var user = First(simulations, Uses);
            IsUsed = user != null;
            Runtime = new ProgramRuntime(user ?? (simulations.Count > 0 ? simulations[0] : new SimulationSettings()));
        }

        /// <summary>The runtime for which the programs are compiled. It comes from a simulation that uses them, otherwise from the first simulation.</summary>
        internal ProgramRuntime Runtime { get; }

        /// <summary>Whether one of the simulations runs its programs.</summary>
        internal bool IsUsed { get; }

        /// <summary>The schema's path from the project's folder.</summary>
        internal string Schema { get; }

        internal string Name => Path.GetFileNameWithoutExtension(Schema);

        internal string Generated => Path.Combine(Path.GetDirectoryName(Schema), "Generated");

        internal string Programs => Path.Combine(Path.GetDirectoryName(Schema), "Programs");

        /// <summary>The jar, an asset that can be committed.</summary>
        internal string Jar => Path.ChangeExtension(Schema, ProgramLibrary.Extension);

        internal bool HasPrograms => SourceHash.KotlinFiles(Programs).Length > 0;

        /// <summary>The hash of the schema and the programs as they are now.</summary>
        internal string Sources => SourceHash.Of(Schema, Programs);

        /// <summary>
        /// Whether the jar was built from other sources, for another runtime or by another version of the package, whose generated code is specific to it.
        /// A project with neither programs nor a jar is not.
        /// </summary>
        /// <exception cref="ToolException">The runtime's jars are missing.</exception>
        internal bool IsStale
        {
            get
            {
                if (!HasPrograms && !File.Exists(Jar)) return false;
                var attributes = JarManifest.Read(Jar);
                bool Has(string name, string value) => attributes.TryGetValue(name, out var built) && built == value;
                return !Has("Collektive-Version", PackageState.Version) || !Has("Collektive-Runtime", Runtime.ManifestValue)
                    || !Has("Collektive-Sources", Sources);
            }
        }

        /// <summary>Whether any of these files is below the schema's folder.</summary>
        internal bool HasAny(IEnumerable<string> files)
        {
            var folder = Path.GetDirectoryName(Schema).Replace('\\', '/') + "/";
            foreach (var file in files)
            {
                if (file.StartsWith(folder, StringComparison.Ordinal)) return true;
            }
            return false;
        }

        /// <summary>Whether any of its C# was written since then.</summary>
        internal bool HasGeneratedSince(DateTime time) => Directory.Exists(Generated)
            && Array.Exists(Directory.GetFiles(Generated, "*.cs", SearchOption.AllDirectories), file => File.GetLastWriteTimeUtc(file) >= time);

        /// <summary>The same, for the simulations of the loaded scenes.</summary>
        internal static List<SchemaProject> FindAll()
        {
#if UNITY_6000_5_OR_NEWER
            var managers = Object.FindObjectsByType<SimulationManager>();
#else
            var managers = Object.FindObjectsByType<SimulationManager>(FindObjectsSortMode.None);
#endif
            return FindAll(Array.ConvertAll(managers, manager => manager.Settings));
        }

        /// <summary>All schemas below <c>Assets</c>, by path, without folders that Unity ignores.</summary>
        internal static List<SchemaProject> FindAll(IReadOnlyList<SimulationSettings> simulations)
        {
            var found = new List<SchemaProject>();
            if (!Directory.Exists("Assets")) return found;
            foreach (var schema in Directory.GetFiles("Assets", "*.fbs", SearchOption.AllDirectories))
            {
                var path = schema.Replace('\\', '/');
                if (!path.Contains("~/") && !path.Contains("/.")) found.Add(new SchemaProject(path, simulations));
            }
            found.Sort((a, b) => string.CompareOrdinal(a.Schema, b.Schema));
            return found;
        }

        private bool Uses(SimulationSettings simulation) => simulation.JarPaths.Contains(Jar)
            || simulation.JarPaths.Count == 0 && Schemas.TryFind(simulation.schema)?.File == Name;

        private static SimulationSettings First(IReadOnlyList<SimulationSettings> simulations, Predicate<SimulationSettings> matches)
        {
            foreach (var simulation in simulations)
            {
                if (matches(simulation)) return simulation;
            }
            return null;
        }
    }
}
