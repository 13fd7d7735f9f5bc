using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using Collektive.Bridge;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor
{
    /// <summary>What programs are compiled for: the built-in runtime, or Collektive with jars and a compiler plugin of the user's.</summary>
    internal sealed class ProgramRuntime
    {
        private const string PluginEntry = "META-INF/services/org.jetbrains.kotlin.compiler.plugin.CompilerPluginRegistrar";

        private readonly string jars = "";
        private readonly string plugin = "";

        internal ProgramRuntime(SimulationSettings settings)
        {
            if (settings.runtime == AggregateRuntime.BuiltIn) return;
            Kind = settings.runtime;
            jars = settings.runtimeJars;
            plugin = settings.runtimePlugin;
        }

        /// <summary>That of the open scene's manager; the built-in one where there is none.</summary>
        internal static ProgramRuntime OfScene()
        {
            var manager = Object.FindAnyObjectByType<SimulationManager>();
            return new ProgramRuntime(manager == null ? new SimulationSettings() : manager.Settings);
        }

        internal AggregateRuntime Kind { get; } = AggregateRuntime.BuiltIn;

        /// <summary>What the host reads of a jar to refuse programs of another runtime.</summary>
        /// <exception cref="ToolException">There is no folder of jars.</exception>
        internal string Mark => Kind == AggregateRuntime.BuiltIn ? "builtIn" : "collektive " + Hash(Jars());

        /// <summary>The jars that programs are compiled against, beside the host's.</summary>
        /// <exception cref="ToolException">There is no folder of jars.</exception>
        internal IReadOnlyList<string> Library => Kind == AggregateRuntime.BuiltIn ? new[] { Installation.LibraryJar } : Jars();

        /// <summary>Options of the Kotlin compiler, and sources that are compiled with the programs.</summary>
        /// <exception cref="ToolException">The compiler plugin is none.</exception>
        internal string[] Arguments()
        {
            if (Kind == AggregateRuntime.BuiltIn) return new[] { "-Xplugin=" + Toolchain.CompilerPlugin };
            var path = string.IsNullOrWhiteSpace(plugin) ? "" : Installation.PathOf(plugin);
            if (!File.Exists(path))
                throw new ToolException("programs for Collektive are compiled with its compiler plugin, and there is no jar '" + plugin
                    + "': name it as Runtime Plugin in the Simulation Manager's settings");
            if (!IsPlugin(path))
                throw new ToolException(path + " is no plugin of the Kotlin compiler: name Collektive's compiler-plugin as Runtime Plugin");
            return new[] { "-Xplugin=" + path, "-P", "plugin:it.unibo.collektive.collektive-compiler-plugin:collektiveEnabled=true", Toolchain.Links };
        }

        private string[] Jars()
        {
            var folder = string.IsNullOrWhiteSpace(jars) ? "" : Installation.PathOf(jars);
            var found = Directory.Exists(folder) ? Directory.GetFiles(folder, "*.jar") : new string[0];
            if (found.Length == 0)
                throw new ToolException("there are no jars of Collektive in '" + jars
                    + "': put its dsl and stdlib and all that they need into a folder, and name it as Runtime Jars in the Simulation Manager's settings");
            Array.Sort(found, StringComparer.Ordinal);
            return found;
        }

        /// <summary>The names of a jar's entries are not compressed.</summary>
        private static bool IsPlugin(string path) => Encoding.ASCII.GetString(File.ReadAllBytes(path)).Contains(PluginEntry);

        private static string Hash(string[] jars)
        {
            using (var hash = IncrementalHash.CreateHash(HashAlgorithmName.SHA256))
            {
                foreach (var jar in jars) hash.AppendData(File.ReadAllBytes(jar));
                return BitConverter.ToString(hash.GetHashAndReset()).Replace("-", "").ToLowerInvariant();
            }
        }
    }
}
