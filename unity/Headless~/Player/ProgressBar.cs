using System;
using System.Diagnostics;
using System.Globalization;

namespace Collektive.Headless
{
    /// <summary>Prints the progress of a run to standard error. On a terminal, it is a bar; otherwise, it is a line every few seconds.</summary>
    internal sealed class ProgressBar
    {
        private const int Width = 30;

        private readonly bool terminal = !Console.IsErrorRedirected;
        private readonly Stopwatch clock = Stopwatch.StartNew();
        private readonly int total;
        private double next;

        internal ProgressBar(int total)
        {
            this.total = total;
        }

        internal double Seconds => clock.Elapsed.TotalSeconds;

        /// <summary>Whether it is time to print the progress again.</summary>
        internal bool Due => clock.Elapsed.TotalSeconds >= next;

        internal void Show(int tick, double simulated, string extra)
        {
            next = clock.Elapsed.TotalSeconds + (terminal ? 0.2 : 5);
            var done = (int)((long)Width * tick / total);
            var rate = tick / Math.Max(clock.Elapsed.TotalSeconds, 1e-9);
            var line = string.Format(
                CultureInfo.InvariantCulture, "[{0}{1}] tick {2}/{3}, {4:0.0} s simulated, {5:0} ticks/s{6}",
                new string('#', done), new string('.', Width - done), tick, total, simulated, rate, extra);
            Console.Error.Write(terminal ? "\r" + line + "   " : line + "\n");
        }

        internal void End()
        {
            if (terminal) Console.Error.WriteLine();
        }
    }
}
