using System;
using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Files that are made under a name of their own and renamed when they are whole: another editor may make the same file of the same project at this
    /// moment, and a reader finds the former one or the new one.
    /// </summary>
    internal static class FinishedFile
    {
        /// <summary>A name beside <paramref name="path"/> that no other process uses.</summary>
        internal static string NameOfPart(string path) => path + "." + Guid.NewGuid().ToString("N") + ".part";

        /// <summary>Gives <paramref name="part"/> its name; a file of that name is replaced in one go.</summary>
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
