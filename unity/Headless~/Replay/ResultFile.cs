using System;
using System.IO;
using System.Text;
using Mono.Unix;
using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>Creates the files of a run. It never writes through a symbolic link. Files that were synced survive a power failure.</summary>
    internal static class ResultFile
    {
        /// <summary>Whether files are synced, which takes some milliseconds each. A sweep syncs the files of a run itself.</summary>
        internal static bool Syncs { get; set; } = true;

        private static string folder;
        private static int folderDescriptor = -1;

        /// <summary>
        /// Opens the folder of a run. After a user has moved, deleted or replaced it, this class writes and deletes no file at its path, because another run
        /// may use the path.
        /// </summary>
        internal static void OpenFolder(string path)
        {
            if (folderDescriptor >= 0) Syscall.close(folderDescriptor);
            folder = path;
            folderDescriptor = Syscall.open(path, OpenFlags.O_RDONLY | OpenFlags.O_CLOEXEC);
            if (folderDescriptor < 0) throw Failure(path);
        }

        /// <summary>Creates a file that grows during the run. An existing file is replaced.</summary>
        internal static StreamWriter Create(string path)
        {
            RequireFolder(path);
            File.Delete(path);
            return new StreamWriter(new FileStream(path, FileMode.CreateNew, FileAccess.Write, FileShare.Read), new UTF8Encoding(false));
        }

        /// <summary>
        /// Throws an <see cref="IOException"/> if a user has moved, deleted or replaced a file of <see cref="Create"/>, because its rows would be lost.
        /// </summary>
        internal static void RequireInPlace(TextWriter writer)
        {
            if (!((writer as StreamWriter)?.BaseStream is FileStream file)) return;
            if (!IsAt((int)file.SafeFileHandle.DangerousGetHandle(), file.Name)) throw Replaced(file.Name);
        }

        /// <summary>Deletes a file of <see cref="Create"/>, unless the folder was replaced.</summary>
        internal static void Delete(string path)
        {
            if (IsInPlace(path)) File.Delete(path);
        }

        /// <summary>
        /// Writes a temporary file beside <paramref name="path"/>, syncs it, and renames it to the target. After an exception, the target is unchanged.
        /// </summary>
        internal static void Write(string path, Action<TextWriter> write)
        {
            var part = path + ".part";
            try
            {
                using (var writer = Create(part)) write(writer);
                Sync(part);
                RequireFolder(path);
                if (Syscall.renameat(Syscall.AT_FDCWD, part, Syscall.AT_FDCWD, path) != 0) throw Failure(path);
                Sync(Path.GetDirectoryName(Path.GetFullPath(path)));
            }
            catch
            {
                Delete(part);
                throw;
            }
        }

        /// <summary>Waits until a file, or the list of files in a folder, is on disk. Does nothing if the file does not exist.</summary>
        internal static void Sync(string path)
        {
            if (!Syncs) return;
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

        private static void RequireFolder(string path)
        {
            if (!IsInPlace(path)) throw Replaced(folder);
        }

        private static bool IsInPlace(string path) => Path.GetDirectoryName(path) != folder || IsAt(folderDescriptor, folder);

        private static bool IsAt(int descriptor, string path) => Syscall.fstat(descriptor, out var open) == 0 && Syscall.lstat(path, out var found) == 0
            && found.st_ino == open.st_ino && found.st_dev == open.st_dev;

        private static IOException Replaced(string path) => new IOException("'" + path + "' was moved, deleted or replaced during the run");

        private static IOException Failure(string path) => new IOException("'" + path + "': " + UnixMarshal.GetErrorDescription(Stdlib.GetLastError()));
    }
}
