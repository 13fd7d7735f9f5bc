using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;

namespace Collektive.Bridge
{
    /// <summary>Location of the JVM.</summary>
    public enum JvmLocation
    {
        /// <summary>The JVM package, or <c>JAVA_HOME</c>.</summary>
        Automatic,
        /// <summary>The JVM package only.</summary>
        Bundled,
        /// <summary>The environment variable <c>JAVA_HOME</c>.</summary>
        JavaHome,
        /// <summary>The folder <see cref="JvmSettings.home"/>.</summary>
        Folder,
    }

    /// <summary>The process that the JVM runs in, which does not affect results.</summary>
    public enum JvmPlacement
    {
        /// <summary>A thread of this process. A process can start only one JVM.</summary>
        InProcess,
        /// <summary>A child process, connected by shared memory. A crash ends only the session, and the next session can have other settings.</summary>
        OwnProcess,
    }

    /// <summary>The garbage collector.</summary>
    public enum JvmCollector
    {
        /// <summary>Serial, unless a flag selects another.</summary>
        Automatic,
        /// <summary>G1, a balance between throughput and short pauses.</summary>
        G1,
        /// <summary>Serial, which uses one thread. It starts fastest and needs the least memory.</summary>
        Serial,
        /// <summary>Parallel, with the highest throughput and long pauses.</summary>
        Parallel,
        /// <summary>ZGC, with pauses below a millisecond.</summary>
        Z,
        /// <summary>Shenandoah, with pauses of a few milliseconds. Not every JVM has it.</summary>
        Shenandoah,
    }

    /// <summary>How the JVM compiles programs to machine code.</summary>
    public enum JvmCompiler
    {
        /// <summary>Compiles quickly first, then optimises frequently executed code.</summary>
        Tiered,
        /// <summary>Uses the quick compiler only: faster at first, slower in the long run.</summary>
        C1,
        /// <summary>Does not compile, for finding compiler bugs.</summary>
        Interpreter,
    }

    /// <summary>
    /// The settings of the JVM. They are read when the JVM starts, which with <see cref="JvmPlacement.InProcess"/> is once per process. <see
    /// cref="JvmSetting.All"/> describes each field, and scenario files use the field names as keys.
    /// </summary>
    [Serializable]
    public sealed class JvmSettings
    {
        /// <summary>Location of the JVM.</summary>
        public JvmLocation location = JvmLocation.Automatic;

        /// <summary>Root of a JRE or JDK, for <see cref="JvmLocation.Folder"/>.</summary>
        public string home = "";

        /// <summary>Where the JVM runs.</summary>
        public JvmPlacement placement = JvmPlacement.InProcess;

        /// <summary>Whether a JVM in a separate process keeps running between two plays. The next Play then starts faster.</summary>
        public bool keepWarm = true;

        /// <summary>Heap at the start in MiB; 0: the JVM's default.</summary>
        public int initialHeapMb;

        /// <summary>Maximum heap in MiB; 0: the JVM's default, a quarter of the machine's memory.</summary>
        public int maximumHeapMb;

        /// <summary>The garbage collector.</summary>
        public JvmCollector collector = JvmCollector.Automatic;

        /// <summary>How the JVM compiles programs to machine code.</summary>
        public JvmCompiler compiler = JvmCompiler.Tiered;

        /// <summary>Number of calls after which code is compiled, as a percentage of the JVM's default.</summary>
        public int compileThreshold = 100;

        /// <summary>Memory for compiled code in MiB; 0: the JVM's default.</summary>
        public int codeCacheMb;

        /// <summary>Whether loaded classes are archived for a faster next start.</summary>
        public bool cdsArchive = true;

        /// <summary>Whether <c>assert</c> statements of programs are checked.</summary>
        public bool assertions;

        /// <summary>TCP port on the loopback interface for debuggers; 0: none.</summary>
        public int debugPort;

        /// <summary>Whether <c>sin</c>, <c>exp</c> and others give bit-identical results on all JVMs and processors.</summary>
        public bool repeatableMaths;

        /// <summary>Additional JVM options, one per entry.</summary>
        public List<string> flags = new List<string>();

        /// <summary>Returns a copy that later changes do not affect.</summary>
        internal JvmSettings Copy()
        {
            var copy = (JvmSettings)MemberwiseClone();
            copy.flags = new List<string>(flags);
            return copy;
        }

        /// <summary>Returns all errors that can be found without a JVM.</summary>
        internal List<JvmProblem> FindProblems()
        {
            var problems = new List<JvmProblem>();
            foreach (var setting in JvmSetting.All)
            {
                var problem = setting.FindProblem(this);
                if (problem != null) problems.Add(new JvmProblem(setting.Key, problem));
            }
            if (initialHeapMb > 0 && maximumHeapMb > 0 && initialHeapMb > maximumHeapMb)
            {
                problems.Add(new JvmProblem(
                    nameof(initialHeapMb), "the initial heap, " + initialHeapMb + " MB, is larger than the maximum heap, " + maximumHeapMb + " MB"));
            }
            if (location == JvmLocation.Folder && string.IsNullOrWhiteSpace(home))
            {
                problems.Add(new JvmProblem(nameof(home), "choose the root folder of a JRE or JDK, or another location"));
            }
            foreach (var flag in flags)
            {
                if (string.IsNullOrWhiteSpace(flag)) problems.Add(new JvmProblem(nameof(flags), "a flag is empty: remove the entry"));
                else if (flag.Contains(" -"))
                    problems.Add(new JvmProblem(nameof(flags), "'" + flag + "' contains several flags: give each its own entry"));
            }
            return problems;
        }

        /// <summary>Returns the command line for the JVM at <paramref name="javaHome"/>. Its class archive is kept in <paramref name="cacheFolder"/>.</summary>
        internal JvmLaunch ToLaunch(string javaHome, string hostJar, string cacheFolder)
        {
            var options = new List<string>();
            var note = "";
            if (initialHeapMb > 0) options.Add("-Xms" + Text(initialHeapMb) + "m");
            if (maximumHeapMb > 0) options.Add("-Xmx" + Text(maximumHeapMb) + "m");
            if (collector != JvmCollector.Automatic) options.Add("-XX:+" + JvmSetting.FlagOf(collector));
            else if (!flags.Exists(JvmSetting.IsCollector)) options.AddRange(OwnCollector);
            if (compiler == JvmCompiler.C1) options.Add("-XX:TieredStopAtLevel=1");
            if (compiler == JvmCompiler.Interpreter) options.Add("-Xint");
            if (compileThreshold != 100) options.Add("-XX:CompileThresholdScaling=" + (compileThreshold / 100.0).ToString(CultureInfo.InvariantCulture));
            if (codeCacheMb > 0) options.Add("-XX:ReservedCodeCacheSize=" + Text(codeCacheMb) + "m");
            if (cdsArchive && !HasAgent && JavaVersion(javaHome) >= FirstWithAutomaticArchive) note = AddArchive(options, javaHome, hostJar, cacheFolder);
            if (assertions) options.Add("-ea");
            // Lets the host check whether a debugger is attached.
            if (HasAgent) options.Add("--add-exports=java.base/jdk.internal.vm=ALL-UNNAMED");
            if (debugPort != 0) options.Add("-agentlib:jdwp=transport=dt_socket,server=y,suspend=n,address=127.0.0.1:" + Text(debugPort));
            if (repeatableMaths)
            {
                options.Add("-XX:+UnlockDiagnosticVMOptions");
                options.Add("-XX:-UseLibmIntrinsic");
            }
            options.AddRange(flags);
            return new JvmLaunch(javaHome, hostJar, options) { Note = note, Placement = placement };
        }

        /// <summary>Whether the JVM loads a native agent, such as the debugger's. A JVM with an agent aborts if it must also write a class archive.</summary>
        private bool HasAgent =>
            debugPort != 0 || flags.Exists(flag => flag.StartsWith("-agent", StringComparison.Ordinal) || flag.StartsWith("-Xrun", StringComparison.Ordinal));

        /// <summary>
        /// Returns the feature version of the JVM at <paramref name="javaHome"/>, for example 25, or 0 if its <c>release</c> file does not contain it.
        /// </summary>
        internal static int JavaVersion(string javaHome)
        {
            const string key = "JAVA_VERSION=\"";
            var release = Path.Combine(javaHome, "release");
            if (!File.Exists(release)) return 0;
            foreach (var line in File.ReadAllLines(release))
            {
                if (!line.StartsWith(key, StringComparison.Ordinal)) continue;
                var end = key.Length;
                while (end < line.Length && char.IsDigit(line[end])) end++;
                return int.TryParse(line.Substring(key.Length, end - key.Length), out var version) ? version : 0;
            }
            return 0;
        }

        // Objects that survive two collections are mostly state of nodes, which lives long. The default would copy them up to 15 times, with pauses of 5 ms
        // instead of 1 ms.
        private static readonly string[] OwnCollector = { "-XX:+" + JvmSetting.FlagOf(JvmCollector.Serial), "-XX:MaxTenuringThreshold=2" };

        private const int FirstWithAutomaticArchive = 19;

        /// <summary>An upper bound for the size of the list of files at the end of the host jar.</summary>
        private const int MaxJarDirectoryBytes = 1 << 19;

        /// <summary>
        /// Adds the options for the class archive, which the JVM writes when it exits, and writes again after the JVM itself was updated. The JVM never
        /// replaces an archive that was written for another host jar, so the archive's name contains the size, time and checksums of the jar. It does not
        /// replace an archive without a header either. A JVM that is killed while it writes leaves such an archive, which is therefore removed here.
        /// </summary>
        /// <returns>The reason why no archive is used, or an empty string.</returns>
        private string AddArchive(List<string> options, string javaHome, string hostJar, string cacheFolder)
        {
            var namePrefix = "classes-" + Hash(javaHome + "\n" + hostJar + "\n" + collector) + "-";
            var host = new FileInfo(hostJar);
            var file = Path.Combine(cacheFolder, namePrefix + Hash(host.Exists ? host.LastWriteTimeUtc.Ticks + "\n" + host.Length + EndOf(host) : "") + ".jsa");
            try
            {
                Directory.CreateDirectory(cacheFolder);
                foreach (var archive in Directory.GetFiles(cacheFolder, namePrefix + "*.jsa")) RemoveUnusable(archive, file);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                return "the JVM starts more slowly, without its class archive: the folder '" + cacheFolder + "' cannot be created (" + error.Message + ")";
            }
            options.Add("-XX:+AutoCreateSharedArchive");
            options.Add("-XX:SharedArchiveFile=" + file);
            // Without this option, the JVM logs a line for each class that it omits, and logs errors about an archive before it replaces it.
            options.Add("-Xlog:cds=off");
            return "";
        }

        /// <summary>
        /// Returns the end of a jar, with the checksums of its classes, or an empty string if it cannot be read, which the start of the JVM reports. The JVM
        /// compares only size and time of a jar with an archive.
        /// </summary>
        private static string EndOf(FileInfo jar)
        {
            try
            {
                using (var reader = new BinaryReader(jar.Open(FileMode.Open, FileAccess.Read, FileShare.ReadWrite | FileShare.Delete)))
                {
                    reader.BaseStream.Position = Math.Max(0, jar.Length - MaxJarDirectoryBytes);
                    return Convert.ToBase64String(reader.ReadBytes(MaxJarDirectoryBytes));
                }
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                return "";
            }
        }

        private static string Hash(string text)
        {
            var hash = 14695981039346656037UL;
            foreach (var character in text) hash = (hash ^ character) * 1099511628211UL;
            return hash.ToString("x16", CultureInfo.InvariantCulture);
        }

        /// <summary>
        /// Removes an archive that has another name or no header. If another JVM was still writing the archive, this JVM starts without one, and the
        /// archive is written again when it exits.
        /// </summary>
        private static void RemoveUnusable(string archive, string expected)
        {
            try
            {
                if (archive != expected || !HasHeader(archive)) File.Delete(archive);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                // Another process uses the archive, or has already removed it.
            }
        }

        /// <summary>Returns whether the archive is complete. The JVM first writes zeros in place of the header, and the header last.</summary>
        private static bool HasHeader(string archive)
        {
            using (var stream = new FileStream(archive, FileMode.Open, FileAccess.Read, FileShare.ReadWrite | FileShare.Delete)) return stream.ReadByte() > 0;
        }

        private static string Text(int number) => number.ToString(CultureInfo.InvariantCulture);
    }
}
