using System.IO;
using Collektive.Bridge;

namespace Collektive.Headless.Tests
{
    /// <summary>What a simulation must give back when it ends.</summary>
    public static unsafe class ShimCounts
    {
        /// <summary>Sessions that are open.</summary>
        public static int Sessions => Read().Sessions;

        /// <summary>Slots that are taken.</summary>
        public static int Slots => Read().Slots;

        /// <summary>Threads of this process, those of the JVM included.</summary>
        public static int Threads => Directory.GetDirectories("/proc/self/task").Length;

        private static Shim.Stats Read()
        {
            var stats = new Shim.Stats { Size = (uint)sizeof(Shim.Stats) };
            Shim.Check(Shim.clk_get_stats(&stats));
            return stats;
        }
    }
}
