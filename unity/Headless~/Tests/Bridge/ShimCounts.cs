using System.IO;
using Collektive.Bridge;

namespace Collektive.Headless.Tests
{
    /// <summary>Counts the resources that a simulation must release when it ends.</summary>
    public static unsafe class ShimCounts
    {
        /// <summary>Open sessions.</summary>
        public static int Sessions => Read().Sessions;

        /// <summary>Slots in use.</summary>
        public static int Slots => Read().Slots;

        /// <summary>Threads of this process, including the JVM's.</summary>
        public static int Threads => Directory.GetDirectories("/proc/self/task").Length;

        private static Shim.Stats Read()
        {
            var stats = new Shim.Stats { Size = (uint)sizeof(Shim.Stats) };
            Shim.Check(Shim.clk_get_stats(&stats));
            return stats;
        }
    }
}
