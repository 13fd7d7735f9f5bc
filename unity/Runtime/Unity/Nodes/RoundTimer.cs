using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Decides when the rounds of one node are due. Round k uses the k-th random number of the stream, however often the timer is polled.</summary>
    internal sealed class RoundTimer
    {
        private readonly double origin;
        private readonly double period;
        private readonly double jitter;
        private readonly RandomStream random;
        private long round;
        private double next;

        /// <param name="timing">A valid timing. It is read in the constructor only.</param>
        /// <param name="random">The node's stream for its schedule.</param>
        /// <param name="start">Simulated seconds at which the node joins.</param>
        internal RoundTimer(RoundTiming timing, RandomStream random, double start)
        {
            this.random = random;
            Period = timing.period;
            period = SimulatedSeconds.Exact(Period);
            jitter = SimulatedSeconds.Exact(timing.jitter);
            origin = start + (timing.phase < 0 ? period * random.NextDouble() : SimulatedSeconds.Exact(timing.phase));
            next = Next();
        }

        internal float Period { get; }

        /// <summary>The greatest possible number of seconds from one due time to the next.</summary>
        internal float LongestInterval => (float)(period + jitter);

        /// <summary>Returns whether a round has become due since the last call that returned true. Times must not decrease.</summary>
        internal bool TakeDue(double now)
        {
            if (next > now) return false;
            while (next <= now) next = Next();
            return true;
        }

        private double Next() => origin + round++ * period + (jitter > 0 ? jitter * random.NextDouble() : 0);
    }
}
