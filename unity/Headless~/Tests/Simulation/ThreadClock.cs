using System;
using System.Runtime.InteropServices;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Processor time of the calling thread: what others do on the machine counts little.</summary>
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

        /// <summary>Milliseconds of an action, the least of several tries after a first one that warms it up.</summary>
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
