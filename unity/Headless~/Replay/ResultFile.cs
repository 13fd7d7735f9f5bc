using System;
using System.IO;
using System.Text;
using Mono.Unix;
using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>Creates the files of a run. Never writes through a symbolic link. Synced files survive a power failure.</summary>
    internal static class ResultFile
    {
        /// <summary>Creates a file that grows during the run, and replaces an existing one.</summary>
        internal static StreamWriter Create(string path)
        {
            File.Delete(path);
            return new StreamWriter(new FileStream(path, FileMode.CreateNew, FileAccess.Write, FileShare.Read), new UTF8Encoding(false));
        }

        /// <summary>
        /// Writes a temporary file beside <paramref name="path"/>, syncs it, and replaces the target. After an exception the target is unchanged.
        /// </summary>
        internal static void Write(string path, Action<TextWriter> write)
        {
            var part = path + ".part";
            try
            {
                using (var writer = Create(part)) write(writer);
                Sync(part);
                if (Syscall.renameat(Syscall.AT_FDCWD, part, Syscall.AT_FDCWD, path) != 0) throw Failure(path);
                Sync(Path.GetDirectoryName(Path.GetFullPath(path)));
            }
            catch
            {
                File.Delete(part);
                throw;
            }
        }

        /// <summary>Waits until a file or the entries of a folder are on disk. Ignores a missing file.</summary>
        internal static void Sync(string path)
        {
            var descriptor = Syscall.open(path, OpenFlags.O_RDONLY | OpenFlags.O_NOFOLLOW);
            if (descriptor < 0 && Stdlib.GetLastError() == Errno.ENOENT) return;
            if (descriptor < 0) throw Failure(path);
            try
            {
                // File systems without this call return EINVAL.
                if (Syscall.fsync(descriptor) != 0 && Stdlib.GetLastError() != Errno.EINVAL) throw Failure(path);
            }
            finally
            {
                Syscall.close(descriptor);
            }
        }

        private static IOException Failure(string path) => new IOException("'" + path + "': " + UnixMarshal.GetErrorDescription(Stdlib.GetLastError()));
    }
}
