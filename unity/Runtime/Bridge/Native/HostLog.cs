using System.Diagnostics;
using System.Text;

namespace Collektive.Bridge
{
    /// <summary>Severity of a log line.</summary>
    public enum HostLogLevel
    {
        /// <summary>For developers of the bridge.</summary>
        Debug = 0,
        /// <summary>Standard output of programs, and information.</summary>
        Info = 1,
        /// <summary>Standard error of programs, and warnings.</summary>
        Warning = 2,
        /// <summary>Errors.</summary>
        Error = 3,
    }

    /// <summary>
    /// Polls the log lines of the shim, the JVM and the programs. At most <see cref="LinesPerSecond"/> lines of each severity are returned, so that the
    /// console can keep up; a separate line reports the number of omitted lines. Without the native library, the log is empty. Not thread-safe.
    /// </summary>
    internal sealed unsafe class HostLog
    {
        /// <summary>Maximum number of lines of each severity that <see cref="TryRead"/> returns per second.</summary>
        public const int LinesPerSecond = 100;

        private const int LineCapacity = 16 * 1024;

        private readonly int[] returnedLines = new int[4];
        private long secondBegan = Stopwatch.GetTimestamp();
        private long omittedLines;
        private ulong lost = Lost();

        /// <summary>Removes and returns the oldest line, if any. Allocates only for a returned line.</summary>
        public bool TryRead(out HostLogLevel level, out string line)
        {
            if (Stopwatch.GetTimestamp() - secondBegan >= Stopwatch.Frequency && TryCount(out level, out line)) return true;
            var buffer = stackalloc byte[LineCapacity];
            int number;
            int length;
            while (ShimLibrary.Problem == null && (length = Shim.clk_log_read(&number, buffer, LineCapacity)) >= 0)
            {
                level = (HostLogLevel)number;
                if (returnedLines[number]++ < LinesPerSecond)
                {
                    line = Encoding.UTF8.GetString(buffer, length);
                    return true;
                }
                omittedLines++;
            }
            level = HostLogLevel.Info;
            line = null;
            return false;
        }

        /// <summary>Starts a new second, and returns whether lines were omitted. If so, <paramref name="line"/> reports their number.</summary>
        public bool TryCount(out HostLogLevel level, out string line)
        {
            secondBegan = Stopwatch.GetTimestamp();
            System.Array.Clear(returnedLines, 0, returnedLines.Length);
            var overflowed = Lost() - lost;
            level = HostLogLevel.Warning;
            line = null;
            if (omittedLines == 0 && overflowed == 0) return false;
            line = (omittedLines + (long)overflowed) + " log lines of the JVM and its programs were skipped: the limit is " + LinesPerSecond +
                " lines per second and severity" + (overflowed > 0 ? "; " + overflowed + " of them did not fit into the log buffer" : "");
            lost += overflowed;
            omittedLines = 0;
            return true;
        }

        private static ulong Lost()
        {
            if (ShimLibrary.Problem != null) return 0;
            var stats = new Shim.Stats { Size = (uint)sizeof(Shim.Stats) };
            Shim.Check(Shim.clk_get_stats(&stats));
            return stats.LogsDropped;
        }
    }
}
