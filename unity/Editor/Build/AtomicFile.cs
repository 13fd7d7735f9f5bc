using System;
using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Writes files atomically, under a temporary name that is then renamed. Readers see either the old or the new content, even if another editor writes
    /// the same file at the same time.
    /// </summary>
    internal static class AtomicFile
    {
        /// <summary>Returns a unique name in the folder of <paramref name="path"/>.</summary>
        internal static string TemporaryPath(string path) => path + "." + Guid.NewGuid().ToString("N") + ".part";

        /// <summary>Renames <paramref name="part"/>, and replaces an existing file atomically.</summary>
        internal static void Rename(string part, string path)
        {
            try
            {
                File.Move(part, path);
            }
            catch (IOException) when (File.Exists(part) && File.Exists(path))
            {
                File.Replace(part, path, null);
            }
        }
    }
}
