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
        /// <summary>On a thread of this process, which can start only one JVM.</summary>
        InProcess,
        /// <summary>In a child process over shared memory. A crash ends only the session, and the next one can have other settings.</summary>
        OwnProcess,
    }

    /// <summary>The garbage collector.</summary>
    public enum JvmCollector
    {
        /// <summary>Serial, unless a flag selects another.</summary>
        Automatic,
        /// <summary>A balance of throughput and short pauses.</summary>
        G1,
        /// <summary>One thread, with the lowest overhead and memory and the fastest start.</summary>
        Serial,
        /// <summary>The highest throughput, with long pauses.</summary>
        Parallel,
        /// <summary>Pauses below a millisecond.</summary>
        Z,
        /// <summary>Pauses of a few milliseconds; not every JVM has it.</summary>
        Shenandoah,
    }

    /// <summary>The way in which the JVM compiles programs to machine code.</summary>
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
    /// The settings of the JVM. Read when the JVM starts: once per process with <see cref="JvmPlacement.InProcess"/>. <see cref="JvmSetting.All"/> describes
    /// each field; scenario files use the field names as keys.
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

        /// <summary>The compilation of programs to machine code.</summary>
        public JvmCompiler compiler = JvmCompiler.Tiered;

        /// <summary>Calls before code is compiled, as a percentage of the JVM's default.</summary>
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

        /// <summary>More JVM options, one per entry.</summary>
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

        /// <summary>The options for the JVM at <paramref name="javaHome"/>; its archive of classes is kept in <paramref name="cacheFolder"/>.</summary>
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

        /// <summary>Whether the JVM loads a native agent, such as the debugger's. It aborts if it must also write a class archive.</summary>
        private bool HasAgent =>
            debugPort != 0 || flags.Exists(flag => flag.StartsWith("-agent", StringComparison.Ordinal) || flag.StartsWith("-Xrun", StringComparison.Ordinal));

        /// <summary>The feature number of the JVM at <paramref name="javaHome"/>, for instance 25; 0 if its <c>release</c> file contains none.</summary>
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

        // Objects that survive two collections are mostly nodes' state. The default would copy them up to fifteen times, with pauses of 5 ms instead of 1 ms.
        private static readonly string[] OwnCollector = { "-XX:+" + JvmSetting.FlagOf(JvmCollector.Serial), "-XX:MaxTenuringThreshold=2" };

        private const int FirstWithAutomaticArchive = 19;

        /// <summary>
        /// The JVM writes the archive when it exits, and a new one after the JVM itself has changed. It never replaces an archive of another host jar at the
        /// same path, so the jar's size and time are part of the name. Nor does it replace an archive without a header, which a JVM killed while writing leaves
        /// behind, so such archives are removed.
        /// </summary>
        /// <returns>The reason why no archive is used, or an empty text.</returns>
        private string AddArchive(List<string> options, string javaHome, string hostJar, string cacheFolder)
        {
            var place = "classes-" + Hash(javaHome + "\n" + hostJar + "\n" + collector) + "-";
            var host = new FileInfo(hostJar);
            var file = Path.Combine(cacheFolder, place + Hash(host.Exists ? host.LastWriteTimeUtc.Ticks + "\n" + host.Length : "") + ".jsa");
            try
            {
                Directory.CreateDirectory(cacheFolder);
                foreach (var archive in Directory.GetFiles(cacheFolder, place + "*.jsa")) RemoveUnusable(archive, file);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                return "the JVM starts more slowly, without its class archive: the folder '" + cacheFolder + "' cannot be created (" + error.Message + ")";
            }
            options.Add("-XX:+AutoCreateSharedArchive");
            options.Add("-XX:SharedArchiveFile=" + file);
            // The JVM logs a line for each class that it leaves out, and errors about an archive that it then replaces.
            options.Add("-Xlog:cds=off");
            return "";
        }

        private static string Hash(string text)
        {
            var hash = 14695981039346656037UL;
            foreach (var character in text) hash = (hash ^ character) * 1099511628211UL;
            return hash.ToString("x16", CultureInfo.InvariantCulture);
        }

        /// <summary>
        /// Removes an archive with another name or without a header. If another JVM was writing it, this one starts without an archive, and the next one writes
        /// it again.
        /// </summary>
        private static void RemoveUnusable(string archive, string expected)
        {
            try
            {
                if (archive != expected || !HasHeader(archive)) File.Delete(archive);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                // Another process uses it, or has removed it.
            }
        }

        /// <summary>The header is written last, over zeros.</summary>
        private static bool HasHeader(string archive)
        {
            using (var stream = new FileStream(archive, FileMode.Open, FileAccess.Read, FileShare.ReadWrite | FileShare.Delete)) return stream.ReadByte() > 0;
        }

        private static string Text(int number) => number.ToString(CultureInfo.InvariantCulture);
    }
}
