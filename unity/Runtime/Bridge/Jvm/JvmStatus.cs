using System;
using System.Collections.Generic;
using System.Globalization;
using org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>A snapshot of the running JVM.</summary>
    public sealed class JvmStatus
    {
        private const long Mebi = 1 << 20;

        private readonly Dictionary<string, string> flags = new Dictionary<string, string>();

        internal JvmStatus(ControlResponse response)
        {
            for (var i = 0; i < response.FlagsLength; i++)
            {
                var flag = response.Flags(i).GetValueOrDefault();
                flags.Add(flag.Name, flag.Value);
            }
            var lines = Jvm.Description.Split('\n');
            Home = lines[0];
            Version = lines.Length > 1 ? lines[1] : "";
            var options = new List<string>();
            for (var i = 2; i < lines.Length; i++) options.Add(lines[i]);
            Options = options;
            Process = Jvm.Process;
            Uptime = TimeSpan.FromMilliseconds(response.UptimeMillis);
            HeapUsed = response.HeapUsed;
            HeapCommitted = response.HeapCommitted;
            HeapMaximum = response.HeapMaximum;
            MetaspaceUsed = response.MetaspaceUsed;
            Classes = response.Classes;
            Collections = response.Collections;
            CollectionMs = response.CollectionMillis;
            Recording = (RecordingState)response.Recording;
            RecordingPath = response.RecordingPath ?? "";
            RecordingError = response.RecordingError ?? "";
            RecordingMs = response.RecordingMillis;
            RecordingsWritten = response.RecordingsWritten;
        }

        /// <summary>Root folder of the JVM.</summary>
        public string Home { get; }

        /// <summary>One line about the host and the JVM.</summary>
        public string Version { get; }

        /// <summary>The options with which the JVM was started.</summary>
        public IReadOnlyList<string> Options { get; }

        /// <summary>Process id of a JVM in a separate process; 0 if it runs in this process.</summary>
        public int Process { get; }

        /// <summary>Time since the JVM started.</summary>
        public TimeSpan Uptime { get; }

        /// <summary>Bytes of the heap in use.</summary>
        public long HeapUsed { get; }

        /// <summary>Bytes of memory committed for the heap.</summary>
        public long HeapCommitted { get; }

        /// <summary>Maximum heap size in bytes.</summary>
        public long HeapMaximum { get; }

        /// <summary>Bytes of class metadata in use.</summary>
        public long MetaspaceUsed { get; }

        /// <summary>Number of loaded classes.</summary>
        public int Classes { get; }

        /// <summary>Number of garbage collections so far.</summary>
        public long Collections { get; }

        /// <summary>Milliseconds that garbage collections took so far.</summary>
        public long CollectionMs { get; }

        /// <summary>State of the flight recording.</summary>
        public RecordingState Recording { get; }

        /// <summary>File of the current or last recording; empty before the first.</summary>
        public string RecordingPath { get; }

        /// <summary>The reason why the last action of the recording failed; empty if it succeeded.</summary>
        public string RecordingError { get; }

        /// <summary>Milliseconds that the last action of the recording took, in the background.</summary>
        public int RecordingMs { get; }

        /// <summary>Recordings and dumps written so far.</summary>
        public int RecordingsWritten { get; }

        /// <summary>Effective value of a JVM flag; null if this JVM does not have the flag.</summary>
        internal string Flag(string name) => flags.TryGetValue(name, out var value) ? value : null;

        internal bool Has(string option)
        {
            foreach (var each in Options)
            {
                if (each == option) return true;
            }
            return false;
        }

        internal string Megabytes(string flag) =>
            long.TryParse(Flag(flag), NumberStyles.None, CultureInfo.InvariantCulture, out var bytes)
                ? (bytes / Mebi).ToString(CultureInfo.InvariantCulture) + " MB"
                : "unknown";
    }
}
