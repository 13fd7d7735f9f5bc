using System;

namespace Collektive.Unity.Editor
{
    /// <summary>Computes mean and maximum durations of the phases of the last ticks.</summary>
    internal sealed class TimeAverages
    {
        internal const int Ticks = 100;

        private readonly TickTimes[] times = new TickTimes[Ticks];
        private readonly double[] rounds = new double[Ticks];
        private long added;

        internal int Count => (int)Math.Min(added, Ticks);

        internal void Add(TickTimes tick, double roundMilliseconds)
        {
            times[added % Ticks] = tick;
            rounds[added % Ticks] = roundMilliseconds;
            added++;
        }

        internal (double Mean, double Max) Of(Func<TickTimes, double> phase) => Of(i => phase(times[i]));

        internal (double Mean, double Max) Rounds => Of(i => rounds[i]);

        private (double Mean, double Max) Of(Func<int, double> value)
        {
            var sum = 0.0;
            var max = 0.0;
            for (var i = 0; i < Count; i++)
            {
                sum += value(i);
                max = Math.Max(max, value(i));
            }
            return (Count == 0 ? 0 : sum / Count, max);
        }
    }
}
