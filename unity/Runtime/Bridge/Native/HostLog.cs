using System.Text;

namespace Collektive.Bridge
{
    /// <summary>Severity of a log line.</summary>
    public enum HostLogLevel
    {
        /// <summary>For developers of the bridge.</summary>
        Debug = 0,
        /// <summary>Standard output of programs, and news.</summary>
        Info = 1,
        /// <summary>Standard error of programs, and things to look at.</summary>
        Warning = 2,
        /// <summary>Something failed.</summary>
        Error = 3,
    }

    /// <summary>Log lines of the shim, the JVM and the programs. Polled; lines that nobody polls for are dropped and counted.</summary>
    public static unsafe class HostLog
    {
        private const int LineCapacity = 16 * 1024;

        /// <summary>Takes the oldest line, if there is one. Allocates only when there is one.</summary>
        public static bool TryRead(out HostLogLevel level, out string line)
        {
            var buffer = stackalloc byte[LineCapacity];
            int number;
            var length = Shim.clk_log_read(&number, buffer, LineCapacity);
            level = (HostLogLevel)number;
            line = length < 0 ? null : Encoding.UTF8.GetString(buffer, length);
            return length >= 0;
        }
    }
}
