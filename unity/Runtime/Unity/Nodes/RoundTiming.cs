using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// The times of a node's rounds under the asynchronous schedule, in simulated seconds. Round k is due <c>phase + k * period</c> after the node joined,
    /// plus a random delay of at most <c>jitter</c>. Each tick runs the rounds that became due since the previous tick, at most one per node.
    /// </summary>
    [Serializable]
    public sealed class RoundTiming
    {
        /// <summary>Seconds from one round to the next; at least the manager's delta time.</summary>
        [Tooltip("Simulated seconds from one round to the next; at least the delta time.")]
        [Min(0.001f)]
        public float period = 0.1f;

        /// <summary>Seconds from joining to the first round; negative: random for each node, less than the period.</summary>
        [Tooltip("Simulated seconds from joining to the first round. Negative: random for each node, less than the period.")]
        public float phase = -1;

        /// <summary>Largest random delay of a round in seconds, uniformly distributed; 0 or greater and less than the period.</summary>
        [Tooltip("Largest random delay of a round in simulated seconds, uniformly distributed; less than the period.")]
        [Min(0)]
        public float jitter;

        /// <summary>Returns the first error, or null.</summary>
        /// <param name="deltaTime">Simulated seconds of a tick.</param>
        internal string FindProblem(float deltaTime)
        {
            var problem = FindPeriodProblem(period, deltaTime);
            if (problem != null) return problem;
            if (float.IsNaN(phase) || float.IsInfinity(phase)) return "phase is " + phase + " s: it must be finite";
            if (!(jitter >= 0 && jitter < period)) return "jitter is " + jitter + " s: it must be 0 or greater and less than the period, " + period + " s";
            return null;
        }

        internal static string FindPeriodProblem(float period, float deltaTime) => period >= deltaTime && !float.IsInfinity(period) ? null
            : "period is " + period + " s: it must be finite and at least the delta time, " + deltaTime + " s";
    }
}
