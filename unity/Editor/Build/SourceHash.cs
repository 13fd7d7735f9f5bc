using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using System.Text.RegularExpressions;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Computes the hash of a jar's sources, which the compiler records in the jar. By comparing hashes, the editor finds outdated jars without a JVM, and
    /// without file times, which Git does not preserve. <c>SourceHash.kt</c> defines the hash and computes it too.
    /// </summary>
    internal static class SourceHash
    {
        private static readonly Regex Include = new Regex("\\binclude(?>\\s+|//[^\r\n]*|/\\*[\\s\\S]*?\\*/)*[\"']([^\"']+)[\"']");

        /// <summary>Returns the hash of a schema and a folder of programs, which need not exist.</summary>
        internal static string Of(string schema, string programs)
        {
            using (var hash = IncrementalHash.CreateHash(HashAlgorithmName.SHA256))
            {
                var root = Path.GetDirectoryName(Path.GetFullPath(schema));
                var schemas = new SortedDictionary<string, string>(StringComparer.Ordinal);
                AddIncluded(Path.GetFullPath(schema), root, schemas);
                Append(hash, schemas);
                var kotlin = new SortedDictionary<string, string>(StringComparer.Ordinal);
                foreach (var file in KotlinFiles(programs)) kotlin[Name(Path.GetFullPath(programs), Path.GetFullPath(file))] = file;
                Append(hash, kotlin);
                return BitConverter.ToString(hash.GetHashAndReset()).Replace("-", "").ToLowerInvariant();
            }
        }

        internal static string[] KotlinFiles(string programs) =>
            Directory.Exists(programs) ? Directory.GetFiles(programs, "*.kt", SearchOption.AllDirectories) : new string[0];

        private static void AddIncluded(string file, string root, SortedDictionary<string, string> found)
        {
            if (!found.TryAdd(Name(root, file), file)) return;
            foreach (Match include in Include.Matches(Encoding.UTF8.GetString(File.ReadAllBytes(file))))
            {
                foreach (var folder in new[] { Path.GetDirectoryName(file), root })
                {
                    var included = Path.GetFullPath(Path.Combine(folder, include.Groups[1].Value));
                    if (!File.Exists(included)) continue;
                    AddIncluded(included, root, found);
                    break;
                }
            }
        }

        private static string Name(string folder, string file) => Path.GetRelativePath(folder, file).Replace('\\', '/');

        private static void Append(IncrementalHash hash, SortedDictionary<string, string> files)
        {
            var zero = new byte[1];
            foreach (var file in files)
            {
                hash.AppendData(Encoding.UTF8.GetBytes(file.Key));
                hash.AppendData(zero);
                hash.AppendData(Array.FindAll(File.ReadAllBytes(file.Value), value => value != '\r'));
                hash.AppendData(zero);
            }
        }
    }
}
