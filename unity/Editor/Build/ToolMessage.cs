using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text.RegularExpressions;

namespace Collektive.Unity.Editor
{
    /// <summary>A tool's message about a position in a source file.</summary>
    internal readonly struct ToolMessage
    {
        // flatc: "x.fbs:3: 12: error: text", on Windows "x.fbs(3, 12): error: text". Kotlin: "X.kt:3:12: error: text". javac: "X.java:3: error: text".
        private static readonly Regex Place = new Regex(
            @"^\s*(?:file://)?(?<file>(?:[A-Za-z]:)?[^:(]+\.(?:fbs|kt|kts|java))"
            + @"(?::(?<line>\d+)(?::\s?(?<column>\d+))?|\((?<line>\d+)(?:,\s*(?<column>\d+))?\)):\s*(?<kind>error|warning):\s*(?<text>.*)$");

        // flatc reports some errors at the end of a file, and appends their origin.
        private static readonly Regex Origin = new Regex(@", originally at: (?<file>(?:[A-Za-z]:)?[^:]+):(?<line>\d+)$");

        internal ToolMessage(string file, int line, int column, bool isError, string text)
        {
            File = file;
            Line = line;
            Column = column;
            IsError = isError;
            Text = text;
        }

        internal string File { get; }

        /// <summary>The line, starting from 1.</summary>
        internal int Line { get; }

        /// <summary>The column, starting from 1; 0 if the tool does not report it.</summary>
        internal int Column { get; }

        internal bool IsError { get; }

        /// <summary>The message, followed by the source line if the tool printed it.</summary>
        internal string Text { get; }

        /// <summary>Returns all messages in the output of flatc, the Kotlin compiler or javac.</summary>
        internal static List<ToolMessage> Parse(string output)
        {
            var messages = new List<ToolMessage>();
            var lines = Array.ConvertAll(output.Split('\n'), line => line.TrimEnd('\r'));
            for (var i = 0; i < lines.Length; i++)
            {
                var match = Place.Match(lines[i]);
                if (!match.Success) continue;
                // Kotlin and javac print the source line, and mark the position in the line below.
                var hasSource = i + 2 < lines.Length && lines[i + 2].Contains("^") && lines[i + 2].Trim(' ', '^').Length == 0;
                messages.Add(Of(match, hasSource ? "\n" + lines[i + 1] : ""));
            }
            return messages;
        }

        private static ToolMessage Of(Match match, string source)
        {
            var text = match.Groups["text"].Value;
            var isError = match.Groups["kind"].Value == "error";
            var origin = Origin.Match(text);
            if (origin.Success) return new ToolMessage(origin.Groups["file"].Value, Number(origin.Groups["line"]), 0, isError, text.Substring(0, origin.Index));
            return new ToolMessage(match.Groups["file"].Value, Number(match.Groups["line"]), Number(match.Groups["column"]), isError, text + source);
        }

        private static int Number(Group group) => group.Success ? int.Parse(group.Value, CultureInfo.InvariantCulture) : 0;
    }
}
