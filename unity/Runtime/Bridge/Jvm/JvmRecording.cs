using System;
using System.IO;
using org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>
    /// Controls the JVM's flight recording while the JVM runs, even between two ticks. Each member waits up to 10 s for a running tick. Starting and writing
    /// run in the background; <see cref="Jvm.GetStatus"/> reports their progress. When the JVM exits, a running recording is written. All members may be called
    /// from any thread.
    /// </summary>
    public static class JvmRecording
    {
        /// <summary>Settings with low overhead, for continuous recording.</summary>
        public const string Default = "default";

        /// <summary>Settings with more samples.</summary>
        public const string Profile = "profile";

        /// <summary>Starts a recording; <paramref name="path"/> (usually <c>.jfr</c>) is written at its stop.</summary>
        /// <param name="path">The file; an existing one is replaced.</param>
        /// <param name="settings"><see cref="Default"/>, <see cref="Profile"/>, or the path of a <c>.jfc</c> file.</param>
        /// <exception cref="BridgeException">No JVM runs.</exception>
        public static void Start(string path, string settings = Default)
        {
            if (settings == null) throw new ArgumentNullException(nameof(settings));
            var isFile = settings.EndsWith(".jfc", StringComparison.Ordinal);
            Send(RecordingAction.Start, path, isFile ? Path.GetFullPath(settings) : settings);
        }

        /// <summary>Writes the recorded events to a file. The recording continues.</summary>
        /// <exception cref="BridgeException">No JVM runs.</exception>
        public static void Dump(string path) => Send(RecordingAction.Dump, path, "");

        /// <summary>Ends the recording and writes its file.</summary>
        /// <exception cref="BridgeException">No JVM runs.</exception>
        public static void Stop() => JvmControl.Send(new JvmControl.Query { Recording = RecordingAction.Stop });

        private static void Send(RecordingAction action, string path, string settings)
        {
            if (string.IsNullOrWhiteSpace(path)) throw new ArgumentException("the recording's path is empty: enter the path of a file", nameof(path));
            JvmControl.Send(new JvmControl.Query { Recording = action, Path = Path.GetFullPath(path), Settings = settings });
        }
    }
}
