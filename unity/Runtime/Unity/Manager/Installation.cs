using System;
using System.IO;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Locates the package's files, the host's jar and the JVM.</summary>
    internal static class Installation
    {
        private const string Package = "Packages/org.collektive.unity";

        /// <summary>
        /// Returns the real path of a file that is named relative to the project's folder. The editor replaces this function, because it stores packages
        /// elsewhere.
        /// </summary>
        internal static Func<string, string> ToPhysical
        {
            get => toPhysical;
            set
            {
                toPhysical = value;
                manual = null;
            }
        }

        /// <summary>Returns the path of the asset with a GUID, relative to the project's folder. Set by the editor; null in a player.</summary>
        internal static Func<string, string> ToAssetPath { get; set; }

        private static Func<string, string> toPhysical = InPlayer;
        private static string manual;
        private static string hostJar;
        private static string javaHome;

        /// <summary>Path of the host's jar. The default is the package's jar.</summary>
        internal static string HostJar
        {
            get => hostJar ?? PathOf(OwnFile("collektive-host.jar"));
            set => hostJar = value;
        }

        /// <summary>Path of the jar with the DSL and the standard library, for compiling programs.</summary>
        internal static string LibraryJar => Path.Combine(Path.GetDirectoryName(HostJar), "collektive-library.jar");

        /// <summary>Root of the JVM for the location Automatic. The default is the JVM package, otherwise <c>JAVA_HOME</c>, otherwise empty.</summary>
        internal static string JavaHome
        {
            get => javaHome ?? (Directory.Exists(Bundled) ? Bundled : FromEnvironment);
            set => javaHome = value;
        }

        /// <summary>The package's name for the platform that this process runs on, such as <c>linux-x64</c> or <c>mac-arm64</c>.</summary>
        internal static string Platform { get; } = NameOfPlatform();

        /// <summary>Root of the JVM that is installed with this package or with the JVM package of this platform. The folder may not exist.</summary>
        internal static string Bundled => BundledFor(Platform);

        private static string FromEnvironment => Environment.GetEnvironmentVariable("JAVA_HOME") ?? "";

        /// <summary>Returns the same as <see cref="Bundled"/> for another platform.</summary>
        internal static string BundledFor(string platform)
        {
            var own = PathOf(OwnFile(platform));
            return Directory.Exists(own) ? own : ToPhysical(Package + ".jvm." + platform + "/Jvm~/" + platform);
        }

        /// <summary>Returns the path of a file in the package's folder <c>Jvm~</c>, relative to the project's folder.</summary>
        internal static string OwnFile(string name) => Package + "/Jvm~/" + name;

        /// <summary>Returns the options that start the JVM of <paramref name="settings"/> on this machine.</summary>
        /// <exception cref="BridgeException">The settings are invalid, or the JVM does not exist.</exception>
        internal static JvmLaunch ToLaunch(JvmSettings settings)
        {
            var problems = settings.FindProblems();
            if (problems.Count > 0) throw new BridgeException(BridgeError.JvmOptions, "the JVM settings are invalid: " + problems[0]);
            var jar = Path.GetFullPath(HostJar);
            if (Array.Exists(jar.ToCharArray(), char.IsSurrogate)) throw new BridgeException(
                BridgeError.Host,
                "the JVM cannot load classes from " + jar + ": its path contains an emoji or another character beyond U+FFFF. Rename the folder");
            return settings.ToLaunch(HomeOf(settings), HostJar, Path.Combine(Application.persistentDataPath, "Collektive"));
        }

        /// <summary>
        /// Returns the full path of a file that is named relative to the project's folder. Names below <c>Packages/org.collektive.unity</c> are resolved in
        /// the package, wherever it is installed. A tarball has the package's content in a folder <c>unity</c>; a git URL with <c>?path=/unity</c> does
        /// not.
        /// </summary>
        internal static string PathOf(string file)
        {
            if (!file.StartsWith(Package + "/", StringComparison.Ordinal)) return ToPhysical(file);
            var content = ToPhysical(Package + "/unity");
            return Directory.Exists(content) ? Path.Combine(content, file.Substring(Package.Length + 1)) : ToPhysical(file);
        }

        /// <summary>
        /// Returns the address of a page of the manual. For a release, the page is in the repository; otherwise it is the package's own file.
        /// </summary>
        internal static string AddressOf(string page) => (manual ?? (manual = FindManual())) + page;

        // Inspectors request the address whenever they are drawn, so the file is read only once.
        private static string FindManual()
        {
            var manifest = ToPhysical(Package + "/package.json");
            var index = Regex.Match(File.Exists(manifest) ? File.ReadAllText(manifest) : "", "\"documentationUrl\": *\"([^\"]*/)index\\.md\"");
            return index.Success ? index.Groups[1].Value : new Uri(ToPhysical(Package + "/Documentation~/")).AbsoluteUri;
        }

        /// <summary>
        /// Returns the path below a player's streaming assets for a file that the settings name relative to the project's folder. A file outside of that
        /// folder gets a name that is derived from its path.
        /// </summary>
        internal static string NameInPlayer(string file)
        {
            var name = file.Replace('\\', '/');
            var isOutside = name.StartsWith("/", StringComparison.Ordinal) || name.Contains(":") || Array.IndexOf(name.Split('/'), "..") >= 0;
            // Unity omits folders whose names end with ~.
            return "Collektive/" + (isOutside ? "Elsewhere/" + Uri.EscapeDataString(name) : name.Replace("~/", "/"));
        }

        /// <summary>Returns the path in a player's streaming assets, or the path itself for other files.</summary>
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
