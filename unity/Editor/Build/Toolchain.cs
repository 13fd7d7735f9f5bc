using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using System.Security.Cryptography;
using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// The tools that build schemas and programs. The package ships flatc, the code generator and the compiler plugin; a JDK and the Kotlin
    /// compiler must be installed separately.
    /// </summary>
    internal static class Toolchain
    {
        /// <summary>The version of the Kotlin compiler. The compiler plugin works with this version only.</summary>
        internal const string KotlinVersion = "2.4";

        private static readonly bool Windows = RuntimeInformation.IsOSPlatform(OSPlatform.Windows);

        private const string Tools = "Packages/org.collektive.unity/Tools~/";

        internal static string Generator => PackageTool("collektive-generator.jar");

        internal static string CompilerPlugin => PackageTool("collektive-compiler-plugin.jar");

        /// <summary>
        /// Path of the source of the functions on links. The built-in library contains these functions; for other runtimes, they are compiled with the
        /// programs.
        /// </summary>
        internal static string Links => PackageTool("Links.kt");

        /// <summary>Path of the API for tests of programs.</summary>
        internal static string Testing => PackageTool("collektive-testing.jar");

        internal static string GradleTemplate => PackageTool("build.gradle.kts");

        /// <summary>Folder that contains <c>types.fbs</c>, which schemas may include.</summary>
        internal static string SchemaFolder => Path.GetDirectoryName(PackageTool("types.fbs"));

        /// <summary>
        /// Returns the path of an executable copy of flatc. A copy is needed because package managers do not preserve the permission, and the package's
        /// folder is read-only.
        /// </summary>
        internal static string Flatc()
        {
            if (Installation.Platform == "mac-x64" || Installation.Platform == "linux-arm64")
                throw new ToolException("flatc is not available for " + Installation.Platform + ": generate the code on another machine and commit it");
            var packageTool = PackageTool(Installation.Platform + "/flatc" + (Windows ? ".exe" : ""));
            // The copy's name contains a hash of the content, because package managers set arbitrary file times.
            var copy = Path.GetFullPath("Library/Collektive/Tools/flatc-" + Hash(packageTool) + (Windows ? ".exe" : ""));
            if (File.Exists(copy)) return copy;
            Directory.CreateDirectory(Path.GetDirectoryName(copy));
            var part = AtomicFile.TemporaryPath(copy);
            File.Copy(packageTool, part, true);
            if (!Windows) ToolRun.Do("/bin/chmod", "755", part);
            AtomicFile.Rename(part, copy);
            return copy;
        }

        /// <summary>
        /// Returns the path of a <c>java</c> command of version 17 or newer, for steps that need no compiler. It is searched for in the JVM package, the
        /// JDK in the settings, <c>JAVA_HOME</c>, and the usual folders.
        /// </summary>
        /// <exception cref="ToolException">Not found.</exception>
        internal static string FindJava()
        {
            var candidates = new List<string> { Installation.Bundled, PersonalSettings.instance.jdk };
            AddInstalled(candidates);
            var found = candidates.Find(home => IsJre(home) && Version(home) >= 17);
            return found != null ? Command(found, "java") : throw new ToolException(
                "no Java 17 or newer was found: install a JVM package of Collektive, or a JRE or JDK (Debian and Ubuntu: openjdk-17-jre-headless, otherwise "
                + "adoptium.net), and set JAVA_HOME or its folder in Preferences > Collektive");
        }

        /// <summary>Returns the root of the JDK. It is taken from the settings or <c>JAVA_HOME</c>, or is the newest JDK in the usual folders.</summary>
        /// <exception cref="ToolException">Not found.</exception>
        internal static string FindJdk()
        {
            var named = PersonalSettings.instance.jdk;
            if (named.Length > 0)
                return IsJdk(named) ? named
                    : throw new ToolException("the JDK in the preferences, " + named
                        + ", has no bin/javac: correct its folder in Preferences > Collektive");
            var candidates = new List<string>();
            AddInstalled(candidates);
            var found = candidates.Find(home => IsJdk(home) && Version(home) >= 17);
            return found ?? throw new ToolException(
                "no JDK 17 or newer was found: install one (Debian and Ubuntu: openjdk-17-jdk-headless, otherwise adoptium.net) "
                + "and set its folder in Preferences > Collektive, or JAVA_HOME");
        }

        /// <summary>Returns the root of the Kotlin compiler, from the settings, <c>KOTLIN_HOME</c> or <c>PATH</c>.</summary>
        /// <param name="runtime">The runtime. For Collektive, any version is accepted, because it must match Collektive's plugin.</param>
        /// <exception cref="ToolException">The compiler was not found, or has an unsupported version.</exception>
        internal static string FindKotlin(AggregateRuntime runtime)
        {
            var candidates = new List<string> { PersonalSettings.instance.kotlin, Environment.GetEnvironmentVariable("KOTLIN_HOME") ?? "" };
            foreach (var entry in (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator))
            {
                // Windows allows quotes and empty entries.
                var folder = entry.Trim().Trim('"');
                if (folder.Trim('/', '\\').Length == 0 || folder.IndexOfAny(Path.GetInvalidPathChars()) >= 0) continue;
                // Accept only the bin folder of a compiler, because a link in /usr/bin does not reveal the compiler's folder.
                var parent = Path.GetDirectoryName(folder.TrimEnd('/', '\\'));
                if (File.Exists(Path.Combine(folder, Windows ? "kotlinc.bat" : "kotlinc")) && File.Exists(Path.Combine(parent ?? "", "build.txt")))
                    candidates.Add(parent);
            }
            var home = candidates.Find(candidate => candidate.Length > 0);
            var instructions = "download kotlin-compiler-" + KotlinVersion
                + ".x.zip from github.com/JetBrains/kotlin/releases, unpack it and set its folder kotlinc in Preferences > Collektive";
            if (home == null) throw new ToolException("no Kotlin compiler was found: " + instructions);
            var version = Path.Combine(home, "build.txt");
            if (!Directory.Exists(Path.Combine(home, "lib")) || !File.Exists(version))
                throw new ToolException(home + " is not a Kotlin compiler (lib or build.txt is missing): " + instructions);
            var text = File.ReadAllText(version).Trim();
            if (runtime == AggregateRuntime.BuiltIn && !text.StartsWith(KotlinVersion + ".", StringComparison.Ordinal))
                throw new ToolException("the Kotlin compiler in " + home + " has version " + text + ": " + instructions);
            return home;
        }

        private static string Hash(string file)
        {
            using (var hash = SHA256.Create())
            using (var stream = File.OpenRead(file))
            {
                return BitConverter.ToString(hash.ComputeHash(stream), 0, 8).Replace("-", "").ToLowerInvariant();
            }
        }

        /// <summary>Adds the JVM of <c>JAVA_HOME</c>, and then the JVMs in the usual folders, newest first.</summary>
        private static void AddInstalled(List<string> candidates)
        {
            candidates.Add(Environment.GetEnvironmentVariable("JAVA_HOME") ?? "");
            var installed = new List<string>();
            foreach (var folder in UsualFolders())
            {
                if (Directory.Exists(folder)) installed.AddRange(Directory.GetDirectories(folder));
            }
            // On macOS, a JDK is a bundle.
            installed = installed.ConvertAll(home => Directory.Exists(home + "/Contents/Home") ? home + "/Contents/Home" : home);
            installed.Sort((a, b) => Version(b).CompareTo(Version(a)));
            candidates.AddRange(installed);
        }

        /// <summary>Returns the folders in which installers create JDKs.</summary>
        private static string[] UsualFolders()
        {
            if (RuntimeInformation.IsOSPlatform(OSPlatform.OSX)) return new[] { "/Library/Java/JavaVirtualMachines" };
            if (!Windows) return new[] { "/usr/lib/jvm" };
            var programs = Environment.GetFolderPath(Environment.SpecialFolder.ProgramFiles);
            return new[] { programs + "/Eclipse Adoptium", programs + "/Java", programs + "/Microsoft", programs + "/Zulu" };
        }

        /// <summary>Returns the path of a command of a JVM.</summary>
        internal static string Command(string home, string name) =>
            Path.Combine(home, "bin/" + name + (Windows ? ".exe" : ""));

        private static bool IsJre(string home) => home.Length > 0 && File.Exists(Command(home, "java")) && File.Exists(Path.Combine(home, "release"));

        private static bool IsJdk(string home) => IsJre(home) && File.Exists(Command(home, "javac"));

        /// <summary>Returns the major version of a JDK, or 0 if it is unknown.</summary>
        internal static int Version(string home)
        {
            var release = Path.Combine(home, "release");
            if (!File.Exists(release)) return 0;
            foreach (var line in File.ReadAllLines(release))
            {
                const string Key = "JAVA_VERSION=\"";
                if (!line.StartsWith(Key, StringComparison.Ordinal)) continue;
                return int.TryParse(line.Substring(Key.Length).Split('.', '"', '-', '+')[0], out var major) ? major : 0;
            }
            return 0;
        }

        private static string PackageTool(string name)
        {
            var path = Installation.PathOf(Tools + name);
            return File.Exists(path) ? path
                : throw new ToolException("the package's tool " + path
                + " is missing: install the package from its tarball (a source checkout has no built tools)");
        }
    }
}
