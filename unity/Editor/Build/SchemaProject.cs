using System;
using System.Collections.Generic;
using System.IO;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// A user's schema and the files that belong to it. In the schema's folder, <c>Generated</c> contains the generated C# code, <c>Programs</c> the Kotlin
    /// files, and <c>NAME.clkprograms</c> is the jar built from the schema and the Kotlin files.
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

        /// <summary>
        /// The runtime for which the programs are compiled. It is taken from a simulation that uses the programs, or else from the first simulation.
        /// </summary>
        internal ProgramRuntime Runtime { get; }

        /// <summary>Whether one of the simulations runs the project's programs.</summary>
        internal bool IsUsed { get; }

        /// <summary>The schema's path, relative to the project's folder.</summary>
        internal string Schema { get; }

        internal string Name => Path.GetFileNameWithoutExtension(Schema);

        internal string Generated => Path.Combine(Path.GetDirectoryName(Schema), "Generated");

        internal string Programs => Path.Combine(Path.GetDirectoryName(Schema), "Programs");

        /// <summary>The path of the jar, which is an asset that can be committed.</summary>
        internal string Jar => Path.ChangeExtension(Schema, ProgramLibrary.Extension);

        internal bool HasPrograms => SourceHash.KotlinFiles(Programs).Length > 0;

        /// <summary>The hash of the present schema and programs.</summary>
        internal string Sources => SourceHash.Of(Schema, Programs);

        /// <summary>
        /// Whether the jar is outdated: it was built from other sources, for another runtime, by another plugin, or by another package version, whose generated
        /// code would not fit. Without Kotlin files, no jar is outdated, because it could not be rebuilt.
        /// </summary>
        /// <exception cref="ToolException">The runtime's jars are missing.</exception>
        internal bool IsStale
        {
            get
            {
                if (!HasPrograms) return false;
                var attributes = JarManifest.Read(Jar);
                bool Has(string name, string value) => attributes.TryGetValue(name, out var built) && built == value;
                return !Has("Collektive-Version", PackageState.Version) || Runtime.Marks().Exists(mark => !Has(mark.Name, mark.Value))
                    || !Has("Collektive-Sources", Sources);
            }
        }

        /// <summary>Returns whether any of the files is below the schema's folder.</summary>
        internal bool HasAny(IEnumerable<string> files)
        {
            var folder = Path.GetDirectoryName(Schema).Replace('\\', '/') + "/";
            foreach (var file in files)
            {
                if (file.StartsWith(folder, StringComparison.Ordinal)) return true;
            }
            return false;
        }

        /// <summary>Returns whether any of the generated C# files was written at or after a time.</summary>
        internal bool HasGeneratedSince(DateTime time) => Directory.Exists(Generated)
            && Array.Exists(Directory.GetFiles(Generated, "*.cs", SearchOption.AllDirectories), file => File.GetLastWriteTimeUtc(file) >= time);

        /// <summary>
        /// Returns all schemas, with the runtimes of the simulations in the loaded scenes. Active simulations determine them first. Inactive ones follow,
        /// because scripts can activate them.
        /// </summary>
        internal static List<SchemaProject> FindAll()
        {
#if UNITY_6000_5_OR_NEWER
            var managers = Object.FindObjectsByType<SimulationManager>(FindObjectsInactive.Include);
#else
            var managers = Object.FindObjectsByType<SimulationManager>(FindObjectsInactive.Include, FindObjectsSortMode.None);
#endif
            Array.Sort(managers, (a, b) => b.isActiveAndEnabled.CompareTo(a.isActiveAndEnabled));
            return FindAll(Array.ConvertAll(managers, manager => manager.Settings));
        }

        /// <summary>Returns all schemas below <c>Assets</c>, sorted by path, except in folders that Unity ignores.</summary>
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
