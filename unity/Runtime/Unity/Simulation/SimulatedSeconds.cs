namespace Collektive.Unity
{
    /// <summary>Converts settings in simulated seconds from floats to doubles.</summary>
    internal static class SimulatedSeconds
    {
        /// <summary>
        /// Returns the decimal number that the user entered, with at most seven digits: 0.1 rather than 0.10000000149, the nearest float. Sums of ticks
        /// then do not drift, and programs print the times that users expect.
        /// </summary>
        internal static double Exact(float seconds) => seconds > -1e28f && seconds < 1e28f ? (double)(decimal)seconds : seconds;
    }
}
