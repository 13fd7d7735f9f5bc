using System.Diagnostics;
using System.IO;
using System.Text;
using System.Text.RegularExpressions;

namespace Collektive.Unity.Editor
{
    /// <summary>Runs other programs and captures their output.</summary>
    internal static class ToolRun
    {
        /// <summary>Runs a program to its end.</summary>
        /// <returns>The exit code of the program, and its output, including standard error.</returns>
        internal static (int Code, string Output) Try(string folder, string program, params string[] arguments)
        {
            var output = new StringBuilder();
            using (var process = Start(folder, program, output, arguments))
            {
                process.WaitForExit();
                return (process.ExitCode, output.ToString());
            }
        }

        /// <summary>
        /// Starts a program. Its messages are appended to <paramref name="output"/> on other threads, so lock <paramref name="output"/> to read them.
        /// </summary>
        /// <exception cref="ToolException">The program cannot be started.</exception>
        internal static Process Start(string folder, string program, StringBuilder output, params string[] arguments)
        {
            var process = new Process
            {
                StartInfo = new ProcessStartInfo(program)
                {
                    Arguments = Quoted(arguments),
                    WorkingDirectory = folder,
                    UseShellExecute = false,
                    CreateNoWindow = true,
                    RedirectStandardOutput = true,
                    RedirectStandardError = true,
                },
            };
            // Both streams are read continuously, because a full pipe would block the program.
            process.OutputDataReceived += (_, line) => Append(output, line.Data);
            process.ErrorDataReceived += (_, line) => Append(output, line.Data);
            try
            {
                process.Start();
            }
            catch (System.ComponentModel.Win32Exception error)
            {
                throw new ToolException(program + " cannot be started: " + error.Message);
            }
            process.BeginOutputReadLine();
            process.BeginErrorReadLine();
            return process;
        }

        /// <summary>Runs a program that must succeed.</summary>
        /// <exception cref="ToolException">The program failed.</exception>
        internal static void Do(string program, params string[] arguments)
        {
            var (code, output) = Try(".", program, arguments);
            if (code != 0) throw new ToolException(program + " exited with code " + code + ":\n" + output);
        }

        private static void Append(StringBuilder output, string line)
        {
            if (line == null) return;
            lock (output) output.Append(line).Append('\n');
        }

        private static string Quoted(string[] arguments)
        {
            var text = new StringBuilder();
            foreach (var argument in arguments) text.Append(Quoted(argument, Path.DirectorySeparatorChar == '\\')).Append(' ');
            return text.ToString();
        }

        /// <summary>Quotes an argument. On Windows, a backslash is doubled only before a quote, so that <c>\\server\share</c> is not changed.</summary>
        internal static string Quoted(string argument, bool isWindows)
        {
            var escaped = isWindows ? Regex.Replace(argument, "(\\\\*)(\"|$)", match => match.Groups[1].Value + match.Groups[1].Value
                + (match.Groups[2].Length > 0 ? "\\\"" : "")) : argument.Replace("\\", "\\\\").Replace("\"", "\\\"");
            return "\"" + escaped + "\"";
        }
    }
}
