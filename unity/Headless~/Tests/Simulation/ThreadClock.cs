using System;
using System.Runtime.InteropServices;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Measures the processor time of the calling thread, which depends only little on the load of the machine.</summary>
    internal static class ThreadClock
    {
        private const int ThisThread = 3;

        internal static double Milliseconds
        {
            get
            {
                if (clock_gettime(ThisThread, out var time) != 0) throw new InvalidOperationException("clock_gettime failed");
                return time.Seconds * 1000.0 + time.Nanoseconds / 1e6;
            }
        }

        /// <summary>Warms up an action and returns the minimum of its durations in several runs, in milliseconds.</summary>
        internal static double Least(int tries, Action action)
        {
            action();
            var least = double.MaxValue;
            for (var i = 0; i < tries; i++)
            {
                var start = Milliseconds;
                action();
                least = Math.Min(least, Milliseconds - start);
            }
            return least;
        }

        [DllImport("libc", ExactSpelling = true)]
        private static extern int clock_gettime(int clock, out Timespec time);

        private struct Timespec
        {
            internal long Seconds;
            internal long Nanoseconds;
        }
    }
}
