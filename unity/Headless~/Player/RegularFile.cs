using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>Tests for regular files. Reading a pipe or a device may block.</summary>
    internal static class RegularFile
    {
        /// <summary>Returns whether a regular file exists. Follows links.</summary>
        internal static bool Exists(string path) =>
            Syscall.stat(path, out var status) == 0 && (status.st_mode & FilePermissions.S_IFMT) == FilePermissions.S_IFREG;
    }
}
