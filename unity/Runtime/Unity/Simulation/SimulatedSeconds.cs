namespace Collektive.Unity
{
    /// <summary>Converts settings in simulated seconds to doubles.</summary>
    internal static class SimulatedSeconds
    {
        /// <summary>
        /// The decimal number of at most seven digits that a setting was given as, such as 0.1 instead of 0.10000000149, the float next to it. Sums of ticks
        /// then do not drift, and programs print the times that users expect.
        /// </summary>
        internal static double Exact(float seconds) => seconds > -1e28f && seconds < 1e28f ? (double)(decimal)seconds : seconds;
    }
}
