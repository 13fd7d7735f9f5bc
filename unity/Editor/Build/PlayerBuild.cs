using System;
using System.Collections.Generic;
using System.IO;
using Collektive.Bridge;
using UnityEditor;
using UnityEditor.Build;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Adds the JVM, the host's jars and the program libraries to players that contain simulations. The files are copied to the player's streaming assets,
    /// where <see cref="Installation"/> finds them.
    /// </summary>
    internal sealed class PlayerBuild : BuildPlayerProcessor
    {
        private static readonly string[] HostJars = { "collektive-host.jar", "collektive-library.jar", "collektive-adapter.jar" };

        /// <exception cref="BuildFailedException">A simulation in the player would fail to start.</exception>
        public override void PrepareForBuild(BuildPlayerContext buildPlayerContext)
        {
            var options = buildPlayerContext.BuildPlayerOptions;
            var simulations = SceneSimulation.FindAll(options.scenes);
            if (simulations.Count == 0) return;
            var problem = PlayerPlatforms.Find(options.target, out var platforms);
            if (problem != null) throw simulations[0].Failure(problem);

            var files = new SortedDictionary<string, string>(StringComparer.Ordinal);
            foreach (var simulation in simulations) AddPrograms(simulation, files);
            var dependencies = AssetDatabase.GetDependencies(ScenesOf(options, simulations), true);
            // Scripts can use libraries that no simulation lists.
            Refresh(simulations, project => !project.IsUsed && Array.IndexOf(dependencies, project.Jar) >= 0);
            foreach (var path in dependencies)
            {
                var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>(path);
                if (library != null) Add(library, files);
            }
            AddJvms(simulations, platforms, files);
            foreach (var jar in HostJars) Add(Installation.OwnFile(jar), files);
            foreach (var file in files) buildPlayerContext.AddAdditionalPathToStreamingAssets(file.Value, file.Key);
        }

        /// <summary>Returns the scenes that the build names or, if it names none, the open scenes that have been saved.</summary>
        private static string[] ScenesOf(BuildPlayerOptions options, List<SceneSimulation> simulations) =>
            options.scenes?.Length > 0 ? options.scenes : simulations.ConvertAll(simulation => simulation.Scene).FindAll(scene => scene.Length > 0).ToArray();

        private static void AddPrograms(SceneSimulation simulation, SortedDictionary<string, string> files)
        {
            var settings = simulation.Settings;
            var problem = settings.FindProblem() ?? settings.FindLibraryProblem();
            if (problem != null) throw simulation.Failure(problem);
            Refresh(new List<SceneSimulation> { simulation }, project => project.IsUsed);
            try
            {
                Schemas.Find(settings.SchemaName);
            }
            catch (BridgeException error)
            {
                throw simulation.Failure(error.Message);
            }
            foreach (var library in settings.Libraries()) Add(library, files);
            foreach (var jar in settings.jars)
            {
                if (!File.Exists(Installation.PathOf(jar)))
                    throw simulation.Failure("jar " + jar + " does not exist: select a library of programs in the Simulation Manager");
                Add(jar, files);
            }
            if (settings.runtime == AggregateRuntime.BuiltIn) return;
            if (!Directory.Exists(Installation.PathOf(settings.runtimeJars)))
                throw simulation.Failure("the folder of Collektive's jars, " + settings.runtimeJars
                    + ", does not exist: correct Runtime Jars in the Simulation Manager's settings");
            Add(settings.runtimeJars, files);
        }

        private static void Refresh(List<SceneSimulation> simulations, Predicate<SchemaProject> isWanted)
        {
            var failed = ProgramBuild.Refresh(SchemaProject.FindAll(simulations.ConvertAll(simulation => simulation.Settings)).FindAll(isWanted));
            if (failed.Count > 0)
                throw simulations[0].Failure(failed[0].Jar + " is older than its sources because the build failed: fix the errors in the console");
            if (EditorApplication.isCompiling) throw simulations[0].Failure("the C# code of a schema has changed: build again when Unity has compiled it");
        }

        private static void AddJvms(List<SceneSimulation> simulations, string[] platforms, SortedDictionary<string, string> files)
        {
            var dependent = simulations.Find(simulation => simulation.NeedsJvm);
            if (dependent == null) return;
            var missing = Array.FindAll(platforms, platform => !Directory.Exists(Installation.BundledFor(platform)));
            var packages = string.Join(" or ", Array.ConvertAll(missing, platform => "org.collektive.unity.jvm." + platform));
            if (missing.Length == platforms.Length)
                throw dependent.Failure("no JVM package is installed for the player: install " + packages
                    + ", or set Location in the JVM settings to JAVA_HOME or a folder, and install a JVM there on each machine that runs the player");
            if (missing.Length > 0) Debug.LogWarning("the player has no JVM for " + string.Join(" and ", missing) + ": to include one, install " + packages);
            foreach (var platform in platforms)
            {
                if (Array.IndexOf(missing, platform) < 0) files[Installation.NameInPlayer(Installation.OwnFile(platform))] = Installation.BundledFor(platform);
            }
        }

        private static void Add(ProgramLibrary library, SortedDictionary<string, string> files) =>
            files[Installation.NameInPlayer(library.NameInPlayer)] = Installation.PathOf(library.File);

        private static void Add(string file, SortedDictionary<string, string> files) => files[Installation.NameInPlayer(file)] = Installation.PathOf(file);
    }
}
