using System.IO;
using Collektive.Bridge;

namespace Collektive.Headless.Tests
{
    /// <summary>Counts the resources that a simulation must release when it ends.</summary>
    public static unsafe class ShimCounts
    {
        /// <summary>The number of open sessions.</summary>
        public static int Sessions => Read().Sessions;

        /// <summary>The number of slots in use.</summary>
        public static int Slots => Read().Slots;

        /// <summary>The number of threads in this process, including those of the JVM.</summary>
        public static int Threads => Directory.GetDirectories("/proc/self/task").Length;

        private static Shim.Stats Read()
        {
            var stats = new Shim.Stats { Size = (uint)sizeof(Shim.Stats) };
            Shim.Check(Shim.clk_get_stats(&stats));
            return stats;
        }
    }
}
