using System.Diagnostics;
using System.Threading;

namespace Collektive.Headless.Bench
{
    /// <summary>Timing shared by all variants.</summary>
    internal static class Measurement
    {
        internal const double DeltaTime = 0.05;
        internal const int LimitMs = 60000;

        private const int PaceMs = 8;

        internal static double Micros(long begin, long end) => (end - begin) * 1e6 / Stopwatch.Frequency;

        /// <summary>Waits as long as a game waits between two ticks.</summary>
        internal static void Pause() => Thread.Sleep(PaceMs);
    }
}
