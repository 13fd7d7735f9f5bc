using System;
using System.IO;
using System.Text;

namespace Collektive.Headless
{
    /// <summary>Writes files that are whole or not there.</summary>
    internal static class WholeFile
    {
        /// <summary>Writes beside <paramref name="path"/>, then replaces the file of that name, if any. After an exception it is as it was.</summary>
        internal static void Write(string path, Action<TextWriter> write)
        {
            var part = path + ".part";
            try
            {
                using (var writer = new StreamWriter(part, false, new UTF8Encoding(false))) write(writer);
                if (File.Exists(path)) File.Replace(part, path, null);
                else File.Move(part, path);
            }
            catch
            {
                File.Delete(part);
                throw;
            }
        }
    }
}
