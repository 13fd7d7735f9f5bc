using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>Checks for regular files, because reading a pipe or a device may block.</summary>
    internal static class RegularFile
    {
        /// <summary>Returns whether a path is a regular file, or a link to one.</summary>
        internal static bool Exists(string path) =>
            Syscall.stat(path, out var status) == 0 && (status.st_mode & FilePermissions.S_IFMT) == FilePermissions.S_IFREG;
    }
}
