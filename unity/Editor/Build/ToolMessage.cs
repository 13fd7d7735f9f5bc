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

        /// <summary>From 1.</summary>
        internal int Line { get; }

        /// <summary>From 1; 0 if the tool does not report it.</summary>
        internal int Column { get; }

        internal bool IsError { get; }

        internal string Text { get; }

        /// <summary>Returns all messages in the output of flatc, the Kotlin compiler or javac.</summary>
        internal static List<ToolMessage> Parse(string output)
        {
            var messages = new List<ToolMessage>();
            foreach (var line in output.Split('\n'))
            {
                var match = Place.Match(line.TrimEnd('\r'));
                if (match.Success) messages.Add(Of(match));
            }
            return messages;
        }

        private static ToolMessage Of(Match match)
        {
            var text = match.Groups["text"].Value;
            var isError = match.Groups["kind"].Value == "error";
            var origin = Origin.Match(text);
            if (origin.Success) return new ToolMessage(origin.Groups["file"].Value, Number(origin.Groups["line"]), 0, isError, text.Substring(0, origin.Index));
            return new ToolMessage(match.Groups["file"].Value, Number(match.Groups["line"]), Number(match.Groups["column"]), isError, text);
        }

        private static int Number(Group group) => group.Success ? int.Parse(group.Value, CultureInfo.InvariantCulture) : 0;
    }
}
