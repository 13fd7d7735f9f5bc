using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>The runtime that programs are compiled for: the built-in one, or Collektive with the user's jars and compiler plugin.</summary>
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

        internal AggregateRuntime Kind { get; } = AggregateRuntime.BuiltIn;

        /// <summary>The jars that programs are compiled against, in addition to the host's.</summary>
        /// <exception cref="ToolException">The folder of jars is missing or empty.</exception>
        internal IReadOnlyList<string> Library => Kind == AggregateRuntime.BuiltIn ? new[] { Installation.LibraryJar } : Jars();

        /// <summary>The path of the compiler plugin. Empty if none is selected.</summary>
        internal string Plugin =>
            Kind == AggregateRuntime.BuiltIn ? Toolchain.CompilerPlugin : string.IsNullOrWhiteSpace(plugin) ? "" : Installation.PathOf(plugin);

        /// <summary>
        /// Returns the attributes in the manifest of a jar that is compiled for this runtime. The host rejects programs for another runtime by the first one.
        /// The second one is the hash of Collektive's compiler plugin, if it exists; the built-in plugin has the package's version.
        /// </summary>
        /// <exception cref="ToolException">The folder of jars is missing or empty.</exception>
        internal List<(string Name, string Value)> Marks()
        {
            var isBuiltIn = Kind == AggregateRuntime.BuiltIn;
            var marks = new List<(string, string)> { ("Collektive-Runtime", isBuiltIn ? "builtIn" : "collektive " + Hash(Jars())) };
            if (!isBuiltIn && File.Exists(Plugin)) marks.Add(("Collektive-Plugin", Hash(Plugin)));
            return marks;
        }

        /// <summary>Options of the Kotlin compiler, and sources that are compiled with the programs.</summary>
        /// <exception cref="ToolException">The compiler plugin is missing, or not a compiler plugin.</exception>
        internal string[] Arguments()
        {
            if (Kind == AggregateRuntime.BuiltIn) return new[] { "-Xplugin=" + Plugin };
            if (!File.Exists(Plugin))
                throw new ToolException("Collektive's compiler plugin '" + plugin + "' does not exist: select it "
                    + "as Runtime Plugin in the Simulation Manager's settings");
            if (!IsPlugin(Plugin))
                throw new ToolException(Plugin + " is not a plugin of the Kotlin compiler: select Collektive's compiler-plugin as Runtime Plugin");
            return new[] { "-Xplugin=" + Plugin, "-P", "plugin:it.unibo.collektive.collektive-compiler-plugin:collektiveEnabled=true", Toolchain.Links };
        }

        private string[] Jars()
        {
            var folder = string.IsNullOrWhiteSpace(jars) ? "" : Installation.PathOf(jars);
            var found = Directory.Exists(folder) ? Directory.GetFiles(folder, "*.jar") : new string[0];
            if (found.Length == 0)
                throw new ToolException("the folder '" + jars + "' contains no jars of Collektive: put collektive-dsl-jvm, collektive-stdlib-jvm and their "
                    + "dependencies into a folder, and select it as Runtime Jars in the Simulation Manager's settings");
            Array.Sort(found, StringComparer.Ordinal);
            return found;
        }

        /// <summary>Returns whether a jar is a compiler plugin. The names of a jar's entries are not compressed, so they can be searched directly.</summary>
        private static bool IsPlugin(string path) => Encoding.ASCII.GetString(File.ReadAllBytes(path)).Contains(PluginEntry);

        private static string Hash(params string[] jars)
        {
            using (var hash = IncrementalHash.CreateHash(HashAlgorithmName.SHA256))
            {
                foreach (var jar in jars) hash.AppendData(File.ReadAllBytes(jar));
                return BitConverter.ToString(hash.GetHashAndReset()).Replace("-", "").ToLowerInvariant();
            }
        }
    }
}
