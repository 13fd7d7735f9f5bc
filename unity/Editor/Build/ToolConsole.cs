using System;
using System.IO;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor
{
    /// <summary>Logs the output of tools to the console. A click selects the file; the link opens it at the line.</summary>
    internal static class ToolConsole
    {
        /// <summary>Logs the messages in a tool's output, or the whole output as one error if the tool failed without naming a place.</summary>
        internal static void Show(string tool, int code, string output)
        {
            var hasError = false;
            foreach (var message in ToolMessage.Parse(output))
            {
                hasError |= message.IsError;
                Show(message);
            }
            if (code != 0 && !hasError) Debug.LogError(tool + " failed:\n" + output.Trim());
        }

        private static void Show(ToolMessage message)
        {
            var path = InProject(message.File);
            var place = path + "(" + message.Line + (message.Column > 0 ? "," + message.Column : "") + ")";
            var text = place + ": " + (message.IsError ? "error: " : "warning: ") + message.Text
                + "\n<a href=\"" + path + "\" line=\"" + message.Line + "\">" + path + ":" + message.Line + "</a>";
            var asset = AssetDatabase.LoadAssetAtPath<Object>(path);
            if (message.IsError) Debug.LogError(text, asset);
            else Debug.LogWarning(text, asset);
        }

        /// <summary>The path from the project's folder, as the editor names assets; a file elsewhere keeps its own.</summary>
        private static string InProject(string file)
        {
            var full = Path.GetFullPath(file).Replace('\\', '/');
            var project = Path.GetFullPath(".").Replace('\\', '/') + "/";
            return full.StartsWith(project, StringComparison.Ordinal) ? full.Substring(project.Length) : full;
        }
    }
}
