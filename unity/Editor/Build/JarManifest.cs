using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;

namespace Collektive.Unity.Editor
{
    /// <summary>Reads the attributes of a jar's manifest.</summary>
    internal static class JarManifest
    {
        /// <summary>Returns the attributes by name, or none if the jar is damaged or missing.</summary>
        internal static Dictionary<string, string> Read(string jar)
        {
            if (!File.Exists(jar)) return new Dictionary<string, string>();
            try
            {
                using (var archive = ZipFile.OpenRead(jar)) return Read(archive);
            }
            // Some damaged archives make the decoder throw exceptions other than IOException.
            catch (Exception error) when (error is IOException || error is InvalidDataException || error is ArgumentException || error is NotSupportedException)
            {
                return new Dictionary<string, string>();
            }
        }

        /// <summary>Returns the attributes by name, or none if the jar has no manifest.</summary>
        internal static Dictionary<string, string> Read(ZipArchive jar)
        {
            var attributes = new Dictionary<string, string>(StringComparer.OrdinalIgnoreCase);
            using (var reader = new StreamReader(jar.GetEntry("META-INF/MANIFEST.MF")?.Open() ?? Stream.Null))
            {
                var name = "";
                for (var line = reader.ReadLine(); line != null; line = reader.ReadLine())
                {
                    var colon = line.IndexOf(": ", StringComparison.Ordinal);
                    // A line with a leading space continues the previous line.
                    if (line.StartsWith(" ", StringComparison.Ordinal) && name.Length > 0) attributes[name] += line.Substring(1);
                    else if (colon > 0) attributes[name = line.Substring(0, colon)] = line.Substring(colon + 2);
                }
            }
            return attributes;
        }
    }
}
