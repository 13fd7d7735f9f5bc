using System;
using System.IO;
using org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>
    /// Controls the JVM's flight recording while the JVM runs. Each member waits up to 10 s for a running tick. Recordings are started and written in the
    /// background; <see cref="Jvm.GetStatus"/> reports the progress. A recording that is still running when the JVM exits is written to its file. All
    /// members may be called from any thread.
    /// </summary>
    public static class JvmRecording
    {
        /// <summary>Settings with low overhead, for continuous recording.</summary>
        public const string Default = "default";

        /// <summary>Settings with more samples.</summary>
        public const string Profile = "profile";

        /// <summary>Starts a recording, which is written to <paramref name="path"/> when it stops.</summary>
        /// <param name="path">The file, usually with the extension <c>.jfr</c>. An existing file is replaced.</param>
        /// <param name="settings"><see cref="Default"/>, <see cref="Profile"/>, or the path of a <c>.jfc</c> file.</param>
        /// <exception cref="BridgeException">No JVM is running.</exception>
        public static void Start(string path, string settings = Default)
        {
            if (settings == null) throw new ArgumentNullException(nameof(settings));
            var isFile = settings.EndsWith(".jfc", StringComparison.Ordinal);
            Send(RecordingAction.Start, path, isFile ? Path.GetFullPath(settings) : settings);
        }

        /// <summary>Writes the recorded events to a file. The recording continues.</summary>
        /// <exception cref="BridgeException">No JVM is running.</exception>
        public static void Dump(string path) => Send(RecordingAction.Dump, path, "");

        /// <summary>Ends the recording and writes its file.</summary>
        /// <exception cref="BridgeException">No JVM is running.</exception>
        public static void Stop() => JvmControl.Send(new JvmControl.Query { Recording = RecordingAction.Stop });

        private static void Send(RecordingAction action, string path, string settings)
        {
            if (string.IsNullOrWhiteSpace(path)) throw new ArgumentException("the recording's path is empty: enter the path of a file", nameof(path));
            JvmControl.Send(new JvmControl.Query { Recording = action, Path = Path.GetFullPath(path), Settings = settings });
        }
    }
}
