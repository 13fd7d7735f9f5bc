using System;
using System.IO;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Unity.Editor
{
    /// <summary>Logs the output of tools to the console. A click on a message selects the file, and a link opens the file at the line.</summary>
    internal static class ToolConsole
    {
        /// <summary>Logs the messages in a tool's output. If the tool failed without naming a position, logs the whole output as one error.</summary>
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
            var position = path + "(" + message.Line + (message.Column > 0 ? "," + message.Column : "") + ")";
            var text = position + ": " + (message.IsError ? "error: " : "warning: ") + message.Text
                + "\n<a href=\"" + path + "\" line=\"" + message.Line + "\">" + path + ":" + message.Line + "</a>";
            var asset = AssetDatabase.LoadAssetAtPath<Object>(path);
            if (message.IsError) Debug.LogError(text, asset);
            else Debug.LogWarning(text, asset);
        }

        /// <summary>
        /// Returns the path of a file relative to the project's folder, as the editor names assets. Paths of files outside of that folder are returned
        /// unchanged.
        /// </summary>
        private static string InProject(string file)
        {
            var full = Path.GetFullPath(file).Replace('\\', '/');
            var project = Path.GetFullPath(".").Replace('\\', '/') + "/";
            return full.StartsWith(project, StringComparison.Ordinal) ? full.Substring(project.Length) : full;
        }
    }
}
