using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>When the rows of a table are due. Ticks are counted, since a sum of times drifts: 50 times 0.02f is less than 1.</summary>
    internal sealed class RowSchedule
    {
        /// <summary>Share of a tick that quotients of seconds may be off by.</summary>
        private const double Tolerance = 1e-6;

        private readonly double interval;
        private readonly double deltaTime;
        private int rows = 1;

        /// <param name="interval">Simulated seconds from one row to the next; the first row is at second 0.</param>
        internal RowSchedule(double interval, float deltaTime)
        {
            this.interval = interval;
            this.deltaTime = SimulatedSeconds.Exact(deltaTime);
        }

        /// <summary>The second of the next row.</summary>
        internal double Next => rows * interval;

        /// <summary>Whether the next row is due after so many ticks.</summary>
        internal bool IsDue(int ticks) => ticks >= Next / deltaTime - Tolerance;

        /// <summary>Goes on to the row after the next one.</summary>
        internal void Advance() => rows++;
    }
}
