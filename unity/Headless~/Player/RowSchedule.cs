using System;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>Determines when rows of a table are due. It counts ticks, because sums of times are inexact: 50 times 0.02f is less than 1.</summary>
    internal sealed class RowSchedule
    {
        /// <summary>Relative tolerance with which times are compared. It permits tick lengths with five digits, such as 0.016667.</summary>
        internal const double Tolerance = 5e-5;

        private readonly double ticksPerRow;
        private int rows = 1;

        /// <param name="interval">Simulated seconds between two rows. The first row is at second 0.</param>
        internal RowSchedule(double interval, float deltaTime)
        {
            ticksPerRow = interval / SimulatedSeconds.Exact(deltaTime);
            // For example, an interval of 1 has exactly three ticks of 0.3333333, even after many rows.
            if (Math.Abs(ticksPerRow - Math.Round(ticksPerRow)) < Tolerance * ticksPerRow) ticksPerRow = Math.Round(ticksPerRow);
        }

        /// <summary>Returns whether the next row is due after a number of ticks.</summary>
        internal bool IsDue(int ticks) => ticks >= rows * ticksPerRow - Tolerance;

        /// <summary>Advances to the following row. Call this method after a row was written.</summary>
        internal void Advance() => rows++;
    }
}
