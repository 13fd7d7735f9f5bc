using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using System.Text.RegularExpressions;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>SHA-256 of the files that a scenario names.</summary>
    internal static class InputHashes
    {
        private static readonly Regex Include = new Regex("^\\s*include\\s+\"([^\"]+)\"", RegexOptions.Multiline);

        // By path: a process that runs several scenarios reads their inputs once.
        private static readonly Dictionary<string, string> Known = new Dictionary<string, string>();

        internal static JObject Of(Scenario scenario)
        {
            var hashes = new JObject(
                new JProperty("scripts", OfFolder(scenario.Scripts, IsScript)),
                new JProperty("schema", OfSchema(scenario.Schema)),
                new JProperty("programs", Directory.Exists(scenario.Programs) ? OfFolder(scenario.Programs, IsProgram) : OfFile(scenario.Programs)));
            if (scenario.RuntimeJars.Length > 0) hashes.Add("runtimeJars", OfFolder(scenario.RuntimeJars, IsJar));
            return hashes;
        }

        internal static string OfFile(string path)
        {
            if (!Known.TryGetValue(path, out var hash)) Known.Add(path, hash = Compute(path));
            return hash;
        }

        private static string Compute(string path)
        {
            using (var sha = SHA256.Create())
            using (var file = File.OpenRead(path)) return Hex(sha.ComputeHash(file));
        }

        /// <summary>Generated code does not count: each run makes it again.</summary>
        private static bool IsScript(string name) => name.EndsWith(".cs", StringComparison.Ordinal) && !name.Contains("/Generated/");

        private static bool IsProgram(string name) => name.EndsWith(".kt", StringComparison.Ordinal) || name.EndsWith(".java", StringComparison.Ordinal);

        private static bool IsJar(string name) => name.EndsWith(".jar", StringComparison.Ordinal);

        /// <summary>Hash of the relative names and the contents of a folder's files, in order of name.</summary>
        private static string OfFolder(string folder, Predicate<string> isMeant)
        {
            var files = new SortedDictionary<string, string>(StringComparer.Ordinal);
            foreach (var path in Directory.GetFiles(folder, "*", SearchOption.AllDirectories))
            {
                var name = path.Substring(folder.TrimEnd('/').Length);
                if (isMeant(name)) files.Add(name, path);
            }
            return OfAll(files);
        }

        /// <summary>
        /// Hash of a schema and of the files that it includes from its folder. Included files of the package do not count: its version names
        /// them.
        /// </summary>
        private static string OfSchema(string schema)
        {
            var files = new SortedDictionary<string, string>(StringComparer.Ordinal);
            var folder = Path.GetDirectoryName(schema);
            var open = new Stack<string>();
            open.Push(Path.GetFileName(schema));
            while (open.Count > 0)
            {
                var name = open.Pop();
                var path = Path.Combine(folder, name);
                if (files.ContainsKey(name) || !File.Exists(path)) continue;
                files.Add(name, path);
                foreach (Match match in Include.Matches(File.ReadAllText(path))) open.Push(match.Groups[1].Value);
            }
            return OfAll(files);
        }

        private static string OfAll(SortedDictionary<string, string> files)
        {
            var list = new StringBuilder();
            foreach (var file in files) list.Append(OfFile(file.Value)).Append("  ").Append(file.Key).Append('\n');
            using (var sha = SHA256.Create()) return Hex(sha.ComputeHash(Encoding.UTF8.GetBytes(list.ToString())));
        }

        private static string Hex(byte[] hash) => BitConverter.ToString(hash).Replace("-", "").ToLowerInvariant();
    }
}
