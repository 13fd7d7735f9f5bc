using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Text;
using UnityEditor;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// The process that keeps the compilers loaded. It receives requests as files in a folder (<c>CompileServer.kt</c>). It outlives reloads of the
    /// editor's code, and ends with the editor.
    /// </summary>
    internal static class CompilerProcess
    {
        private const string Folder = "Library/Collektive/Compiler";

        /// <summary>Key in the session state for the process, its start time, and the tools that it has loaded.</summary>
        private const string Key = "Collektive.Compiler";

        /// <summary>Oldest version of Java that automatically writes an archive of loaded classes.</summary>
        private const int FirstWithAutomaticArchive = 19;

        /// <summary>Tolerance for start times, which are rounded.</summary>
        private const double StartToleranceSeconds = 5;

        private static readonly StringBuilder Messages = new StringBuilder();

        /// <summary>The started process, whose messages are read. Null after a reload of code, although the process still runs.</summary>
        private static Process started;

        /// <summary>Submits a request. Starts the process first if no process with these tools is running.</summary>
        /// <param name="jdk">Root of the JDK.</param>
        /// <param name="kotlin">Root of the Kotlin compiler.</param>
        /// <param name="libraries">Jars that compilations read. A process that has loaded other versions of the jars is replaced.</param>
        /// <param name="options">Options of the compilation.</param>
        /// <returns>The name of the request.</returns>
        /// <exception cref="ToolException">The process cannot be started.</exception>
        internal static string Submit(string jdk, string kotlin, IReadOnlyList<string> libraries, IReadOnlyList<string> options)
        {
            var tools = TextOf(jdk, kotlin, libraries);
            if (!IsRunning || Stored()[2] != tools)
            {
                Kill();
                if (Directory.Exists(Folder)) Directory.Delete(Folder, true);
                Directory.CreateDirectory(Folder);
                Start(jdk, kotlin, tools);
            }
            var name = Guid.NewGuid().ToString("N");
            var part = Path.Combine(Folder, name + ".part");
            File.WriteAllText(part, string.Join("\0", options) + "\0");
            File.Move(part, Path.Combine(Folder, name + ".request"));
            return name;
        }

        /// <summary>Returns the answer to a request.</summary>
        /// <returns>False while the process is still working on the request.</returns>
        /// <exception cref="ToolException">The process ended without an answer.</exception>
        internal static bool TryTake(string name, out int code, out string output)
        {
            var isRunning = IsRunning;
            var response = Path.Combine(Folder, name + ".response");
            code = 0;
            output = "";
            if (!File.Exists(response))
            {
                if (isRunning) return false;
                lock (Messages) throw new ToolException("the compiler process ended: " + (Messages.Length > 0 ? Messages.ToString() : "no message"));
            }
            var text = File.ReadAllText(response);
            File.Delete(response);
            var end = text.IndexOf('\n');
            code = int.Parse(text.Substring(0, end), CultureInfo.InvariantCulture);
            output = text.Substring(end + 1);
            return true;
        }

        /// <summary>Ends the process, and with it the current compilation.</summary>
        internal static void Kill()
        {
            var process = Find();
            SessionState.EraseString(Key);
            try
            {
                process?.Kill();
                process?.WaitForExit();
            }
            catch (InvalidOperationException)
            {
                // The process has ended in the meantime.
            }
            process?.Dispose();
            started?.Dispose();
            started = null;
        }

        private static bool IsRunning
        {
            get
            {
                using (var process = Find()) return process != null;
            }
        }

        /// <summary>Returns the running process, or null. Another process may have reused its id.</summary>
        private static Process Find()
        {
            var stored = Stored();
            if (stored.Length < 3) return null;
            try
            {
                var process = Process.GetProcessById(int.Parse(stored[0], CultureInfo.InvariantCulture));
                var start = new DateTime(long.Parse(stored[1], CultureInfo.InvariantCulture));
                if (!process.HasExited && Math.Abs((process.StartTime - start).TotalSeconds) < StartToleranceSeconds) return process;
                process.Dispose();
            }
            catch (Exception error) when (error is ArgumentException || error is InvalidOperationException || error is System.ComponentModel.Win32Exception)
            {
                // The process does not exist.
            }
            return null;
        }

        private static string[] Stored() => SessionState.GetString(Key, "").Split(new[] { '\n' }, 3);

        private static void Start(string jdk, string kotlin, string tools)
        {
            var options = new List<string> { "-Xmx1g", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1" };
            if (Toolchain.Version(jdk) >= FirstWithAutomaticArchive)
            {
                options.Add("-XX:+AutoCreateSharedArchive");
                options.Add("-XX:SharedArchiveFile=" + Path.GetFullPath("Library/Collektive/Tools/compiler.jsa"));
                options.Add("-Xlog:disable");
                Directory.CreateDirectory("Library/Collektive/Tools");
            }
            options.AddRange(new[]
            {
                "-cp", Path.Combine(kotlin, "lib/*") + Path.PathSeparator + Toolchain.Generator, "org.collektive.generator.CompileCommand", "--serve",
                Path.GetFullPath(Folder), Process.GetCurrentProcess().Id.ToString(CultureInfo.InvariantCulture),
            });
            lock (Messages) Messages.Clear();
            started = ToolRun.Start(".", Toolchain.Command(jdk, "java"), Messages, options.ToArray());
            SessionState.SetString(Key, started.Id + "\n" + started.StartTime.Ticks.ToString(CultureInfo.InvariantCulture) + "\n" + tools);
        }

        /// <summary>Returns a text that identifies the tools and the project, with the size and modification time of each file.</summary>
        private static string TextOf(string jdk, string kotlin, IReadOnlyList<string> libraries)
        {
            var text = new StringBuilder(Path.GetFullPath(Folder)).Append('\n').Append(jdk);
            var files = new List<string>(libraries) { Path.Combine(jdk, "release"), Path.Combine(kotlin, "build.txt"), Toolchain.Generator };
            foreach (var file in files)
            {
                var info = new FileInfo(file);
                if (info.Exists) text.Append('\n').Append(file).Append(' ').Append(info.Length).Append(' ').Append(info.LastWriteTimeUtc.Ticks);
            }
            return text.ToString();
        }
    }
}
