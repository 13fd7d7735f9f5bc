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
    /// compiler are the user's own.
    /// </summary>
    internal static class Toolchain
    {
        /// <summary>The plugin works with this version of the compiler only.</summary>
        internal const string KotlinVersion = "2.4";

        private static readonly bool Windows = RuntimeInformation.IsOSPlatform(OSPlatform.Windows);

        private const string Tools = "Packages/org.collektive.unity/Tools~/";

        internal static string Generator => Shipped("collektive-generator.jar");

        internal static string CompilerPlugin => Shipped("collektive-compiler-plugin.jar");

        /// <summary>Source of what programs know of their links: part of the built-in library, compiled with the programs for another one.</summary>
        internal static string Links => Shipped("Links.kt");

        /// <summary>Folder of <c>types.fbs</c>, which schemas may include.</summary>
        internal static string SchemaFolder => Path.GetDirectoryName(Shipped("types.fbs"));

        /// <summary>flatc, where it may be executed: package managers drop the permission, and the package's folder is not to be written to.</summary>
        internal static string Flatc()
        {
            if (Installation.Platform == "mac-x64" || Installation.Platform == "linux-arm64")
                throw new ToolException("there is no flatc for " + Installation.Platform + ": generate the code on another machine and commit it");
            var shipped = Shipped(Installation.Platform + "/flatc" + (Windows ? ".exe" : ""));
            // By content: package managers set arbitrary file times.
            var copy = Path.GetFullPath("Library/Collektive/Tools/flatc-" + Hash(shipped) + (Windows ? ".exe" : ""));
            if (File.Exists(copy)) return copy;
            Directory.CreateDirectory(Path.GetDirectoryName(copy));
            var part = FinishedFile.NameOfPart(copy);
            File.Copy(shipped, part, true);
            if (!Windows) ToolRun.Do("/bin/chmod", "755", part);
            FinishedFile.Rename(part, copy);
            return copy;
        }

        /// <summary>
        /// The command java of version 17 or newer, for what needs no compiler: the package's own, else that of the JDK in the settings, of
        /// <c>JAVA_HOME</c>, or of the usual folders.
        /// </summary>
        /// <exception cref="ToolException">There is none.</exception>
        internal static string FindJava()
        {
            var candidates = new List<string> { Installation.Bundled, ProjectSettings.instance.jdk };
            AddInstalled(candidates);
            var found = candidates.Find(home => IsJre(home) && Version(home) >= 17);
            return found != null ? Command(found, "java") : throw new ToolException(
                "no Java 17 or newer was found: install a JVM package of ours, or a JRE or JDK (Debian and Ubuntu: openjdk-17-jre-headless, else "
                + "adoptium.net), and set JAVA_HOME or name its folder in Project Settings > Collektive");
        }

        /// <summary>Root of the JDK: what the settings name, else <c>JAVA_HOME</c>, else the newest of the usual folders.</summary>
        /// <exception cref="ToolException">There is none.</exception>
        internal static string FindJdk()
        {
            var named = ProjectSettings.instance.jdk;
            if (named.Length > 0)
                return IsJdk(named) ? named
                    : throw new ToolException("the JDK of the project settings, " + named + ", has no bin/javac: correct it in Project Settings > Collektive");
            var candidates = new List<string>();
            AddInstalled(candidates);
            var found = candidates.Find(home => IsJdk(home) && Version(home) >= 17);
            return found ?? throw new ToolException(
                "no JDK 17 or newer was found: install one (Debian and Ubuntu: openjdk-17-jdk-headless, else adoptium.net) "
                + "and name its folder in Project Settings > Collektive, or set JAVA_HOME");
        }

        /// <summary>Root of the Kotlin compiler: what the settings name, else <c>KOTLIN_HOME</c>, else the one on <c>PATH</c>.</summary>
        /// <param name="runtime">Collektive's plugin works with a version that is not known here.</param>
        /// <exception cref="ToolException">There is none, or it is of another version.</exception>
        internal static string FindKotlin(AggregateRuntime runtime)
        {
            var candidates = new List<string> { ProjectSettings.instance.kotlin, Environment.GetEnvironmentVariable("KOTLIN_HOME") ?? "" };
            foreach (var folder in (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator))
            {
                // The compiler's own bin folder; a link in /usr/bin does not reveal the compiler's folder.
                var parent = Path.GetDirectoryName(folder.TrimEnd('/', '\\'));
                if (File.Exists(Path.Combine(folder, Windows ? "kotlinc.bat" : "kotlinc")) && File.Exists(Path.Combine(parent ?? "", "build.txt")))
                    candidates.Add(parent);
            }
            var home = candidates.Find(candidate => candidate.Length > 0);
            var wanted = "get kotlin-compiler-" + KotlinVersion
                + ".x.zip from github.com/JetBrains/kotlin/releases, unpack it and name its folder kotlinc in Project Settings > Collektive";
            if (home == null) throw new ToolException("no Kotlin compiler was found: " + wanted);
            var version = Path.Combine(home, "build.txt");
            if (!Directory.Exists(Path.Combine(home, "lib")) || !File.Exists(version))
                throw new ToolException(home + " is no Kotlin compiler (it has no lib and build.txt): " + wanted);
            var text = File.ReadAllText(version).Trim();
            if (runtime == AggregateRuntime.BuiltIn && !text.StartsWith(KotlinVersion + ".", StringComparison.Ordinal))
                throw new ToolException("the Kotlin compiler in " + home + " has version " + text + ": " + wanted);
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

        /// <summary>That of <c>JAVA_HOME</c>, then those of the usual folders, the newest first.</summary>
        private static void AddInstalled(List<string> candidates)
        {
            candidates.Add(Environment.GetEnvironmentVariable("JAVA_HOME") ?? "");
            var installed = new List<string>();
            foreach (var folder in UsualFolders())
            {
                if (Directory.Exists(folder)) installed.AddRange(Directory.GetDirectories(folder));
            }
            // A JDK of macOS is a bundle.
            installed = installed.ConvertAll(home => Directory.Exists(home + "/Contents/Home") ? home + "/Contents/Home" : home);
            installed.Sort((a, b) => Version(b).CompareTo(Version(a)));
            candidates.AddRange(installed);
        }

        /// <summary>Where installers put JDKs, one a folder.</summary>
        private static string[] UsualFolders()
        {
            if (RuntimeInformation.IsOSPlatform(OSPlatform.OSX)) return new[] { "/Library/Java/JavaVirtualMachines" };
            if (!Windows) return new[] { "/usr/lib/jvm" };
            var programs = Environment.GetFolderPath(Environment.SpecialFolder.ProgramFiles);
            return new[] { programs + "/Eclipse Adoptium", programs + "/Java", programs + "/Microsoft", programs + "/Zulu" };
        }

        /// <summary>Path of a command of a JVM.</summary>
        internal static string Command(string home, string name) =>
            Path.Combine(home, "bin/" + name + (Windows ? ".exe" : ""));

        private static bool IsJre(string home) => home.Length > 0 && File.Exists(Command(home, "java")) && File.Exists(Path.Combine(home, "release"));

        private static bool IsJdk(string home) => IsJre(home) && File.Exists(Command(home, "javac"));

        /// <summary>The major version of a JDK; 0 when it does not say.</summary>
        private static int Version(string home)
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

        private static string Shipped(string name)
        {
            var path = Installation.PathOf(Tools + name);
            return File.Exists(path) ? path
                : throw new ToolException("the package's tool " + path
                + " is missing: install the package from its tarball (a source checkout has no built tools)");
        }
    }
}
