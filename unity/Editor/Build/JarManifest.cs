using System;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;

namespace Collektive.Unity.Editor
{
    /// <summary>The attributes of a jar.</summary>
    internal static class JarManifest
    {
        /// <summary>Returns the attributes by name, without any for a damaged or missing jar.</summary>
        internal static Dictionary<string, string> Read(string jar)
        {
            var attributes = new Dictionary<string, string>(StringComparer.OrdinalIgnoreCase);
            if (!File.Exists(jar)) return attributes;
            try
            {
                using (var archive = ZipFile.OpenRead(jar))
                using (var reader = new StreamReader(archive.GetEntry("META-INF/MANIFEST.MF")?.Open() ?? Stream.Null))
                {
                    var name = "";
                    for (var line = reader.ReadLine(); line != null; line = reader.ReadLine())
                    {
                        var colon = line.IndexOf(": ", StringComparison.Ordinal);
                        // A space begins the rest of a long line.
                        if (line.StartsWith(" ", StringComparison.Ordinal) && name.Length > 0) attributes[name] += line.Substring(1);
                        else if (colon > 0) attributes[name = line.Substring(0, colon)] = line.Substring(colon + 2);
                    }
                }
            }
            // The decoder throws other exceptions for some damaged archives.
            catch (Exception error) when (error is IOException || error is InvalidDataException || error is ArgumentException || error is NotSupportedException)
            {
                attributes.Clear();
            }
            return attributes;
        }
    }
}
