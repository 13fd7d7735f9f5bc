using System;
using System.IO;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Where the package's files, the host's jar and the JVM are.</summary>
    public static class Installation
    {
        private const string Package = "Packages/org.collektive.unity";

        /// <summary>Gives the real path of a file named from the project's folder. The editor, which keeps packages elsewhere, has its own way.</summary>
        internal static Func<string, string> ToPhysical { get; set; } = InPlayer;

        private static string hostJar;
        private static string javaHome;

        /// <summary>Path of the host's jar: what was set, else the package's own.</summary>
        public static string HostJar
        {
            get => hostJar ?? PathOf(OwnFile("collektive-host.jar"));
            set => hostJar = value;
        }

        /// <summary>Path of what programs are compiled against beside the host's jar: the DSL and its standard library.</summary>
        internal static string LibraryJar => Path.Combine(Path.GetDirectoryName(HostJar), "collektive-library.jar");

        /// <summary>Root of the JVM for settings that do not say: what was set, else the installed packages' own, else <c>JAVA_HOME</c>, else empty.</summary>
        public static string JavaHome
        {
            get => javaHome ?? (Directory.Exists(Bundled) ? Bundled : FromEnvironment);
            set => javaHome = value;
        }

        /// <summary>The package's name of the platform that this process runs on, such as <c>linux-x64</c> or <c>mac-arm64</c>.</summary>
        internal static string Platform { get; } = NameOfPlatform();

        /// <summary>Root of the package's own JVM, or else of that in the JVM package of this platform; none needs to be there.</summary>
        internal static string Bundled => BundledFor(Platform);

        private static string FromEnvironment => Environment.GetEnvironmentVariable("JAVA_HOME") ?? "";

        /// <summary>Of another platform the same as <see cref="Bundled"/>.</summary>
        internal static string BundledFor(string platform)
        {
            var own = PathOf(OwnFile(platform));
            return Directory.Exists(own) ? own : ToPhysical(Package + ".jvm." + platform + "/Jvm~/" + platform);
        }

        /// <summary>A file or folder of the package's JVM side, named from the project's folder.</summary>
        internal static string OwnFile(string name) => Package + "/Jvm~/" + name;

        /// <summary>The words that start the JVM of <paramref name="settings"/> on this machine.</summary>
        /// <exception cref="BridgeException">The settings are invalid, or the JVM does not exist.</exception>
        internal static JvmLaunch ToLaunch(JvmSettings settings)
        {
            var problems = settings.FindProblems();
            if (problems.Count > 0) throw new BridgeException(BridgeError.JvmOptions, "the JVM settings are invalid: " + problems[0]);
            return settings.ToLaunch(HomeOf(settings), HostJar, Path.Combine(Application.persistentDataPath, "Collektive"));
        }

        /// <summary>The jar that the editor makes of the programs of a schema's file for a runtime, from the project's folder.</summary>
        internal static string JarOf(string schemaFile, AggregateRuntime runtime) =>
            "Library/Collektive/" + schemaFile + (runtime == AggregateRuntime.BuiltIn ? "" : "-collektive") + ".jar";

        /// <summary>
        /// The full path of a file named from the project's folder. Names below <c>Packages/org.collektive.unity</c> are the package's own
        /// files, wherever it is installed: a tarball holds its content below <c>unity</c>, a git URL with <c>?path=/unity</c> does not.
        /// </summary>
        internal static string PathOf(string file)
        {
            if (!file.StartsWith(Package + "/", StringComparison.Ordinal)) return ToPhysical(file);
            var content = ToPhysical(Package + "/unity");
            return Directory.Exists(content) ? Path.Combine(content, file.Substring(Package.Length + 1)) : ToPhysical(file);
        }

        /// <summary>
        /// Where below its streaming assets a player has a file that the settings name from the project's folder. Files outside of that folder get a
        /// name made of their path.
        /// </summary>
        internal static string NameInPlayer(string file)
        {
            var name = file.Replace('\\', '/');
            var isOutside = name.StartsWith("/", StringComparison.Ordinal) || name.Contains(":") || Array.IndexOf(name.Split('/'), "..") >= 0;
            // Unity leaves out folders whose names end with ~.
            return "Collektive/" + (isOutside ? "Elsewhere/" + Uri.EscapeDataString(name) : name.Replace("~/", "/"));
        }

        /// <summary>What the build of a player took along; of other files the path itself.</summary>
        internal static string InPlayer(string file)
        {
            var taken = Path.GetFullPath(Path.Combine(Application.streamingAssetsPath, NameInPlayer(file)));
            return File.Exists(taken) || Directory.Exists(taken) ? taken : Path.GetFullPath(file);
        }

        private static string NameOfPlatform()
        {
            var system = RuntimeInformation.IsOSPlatform(OSPlatform.Windows) ? "win"
                : RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? "mac" : "linux";
            return system + (RuntimeInformation.ProcessArchitecture == Architecture.Arm64 ? "-arm64" : "-x64");
        }

        private static string HomeOf(JvmSettings settings)
        {
            switch (settings.location)
            {
                case JvmLocation.Bundled:
                    return Directory.Exists(Bundled) ? Bundled
                        : throw Missing("no JVM is installed with the package: install org.collektive.unity.jvm." + Platform
                            + ", or select another Location in the JVM settings");
                case JvmLocation.JavaHome:
                    return FromEnvironment.Length > 0 ? FromEnvironment
                        : throw Missing("the environment variable JAVA_HOME is not set: set it and restart, or select another Location in the JVM settings");
                case JvmLocation.Folder:
                    return Path.GetFullPath(settings.home);
                default:
                    return JavaHome.Length > 0 ? JavaHome
                        : throw Missing("no JVM was found: install org.collektive.unity.jvm." + Platform
                            + ", set JAVA_HOME, or select a folder in the JVM settings");
            }
        }

        private static BridgeException Missing(string message) => new BridgeException(BridgeError.JvmNotFound, message);
    }
}
