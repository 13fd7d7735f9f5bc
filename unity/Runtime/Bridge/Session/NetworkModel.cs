using System;

namespace Collektive.Bridge
{
    /// <summary>
    /// Loss, delay and retention of messages, in simulated seconds. By default, no message is lost, and each message can be read until the next one
    /// replaces it.
    /// </summary>
    [Serializable]
    public sealed class NetworkModel
    {
        /// <summary>Probability that a message is lost on a link, 0..1.</summary>
        public double loss;

        /// <summary>Increase of the loss per metre of the link's length, 0 or greater.</summary>
        public double lossPerMetre;

        /// <summary>Increase of the loss per unit of the link's attenuation, 0 or greater.</summary>
        public double lossPerAttenuation;

        /// <summary>Seconds between the tick of sending and the arrival, 0 or greater.</summary>
        public double delay;

        /// <summary>Largest additional random delay in seconds, uniformly distributed, 0 or greater.</summary>
        public double jitter;

        /// <summary>Seconds until a received message expires; 0: it is kept until the next one replaces it.</summary>
        public double retention;

        /// <summary>
        /// Share of messages that are sent while their link is in the bad state of the Gilbert-Elliott model, 0 or greater and less than 1; 0: no bursts.
        /// </summary>
        public double burstShare;

        /// <summary>Mean number of successive messages in the bad state, at least 1 and at least share / (1 - share).</summary>
        public double burstLength = 1;

        /// <summary>Probability, 0..1, that a message in the bad state is lost, in addition to the other losses.</summary>
        public double burstLoss = 1;

        /// <summary>Returns the first error, or null.</summary>
        /// <param name="deltaTime">Simulated seconds of a tick.</param>
        internal string FindProblem(double deltaTime)
        {
            if (!(loss >= 0 && loss <= 1)) return "network loss is " + loss + ": it must be from 0 to 1";
            if (!IsAmount(lossPerMetre)) return "network loss per metre is " + lossPerMetre + ": it must be 0 or greater";
            if (!IsAmount(lossPerAttenuation)) return "network loss per attenuation is " + lossPerAttenuation + ": it must be 0 or greater";
            if (!IsAmount(delay)) return "network delay is " + delay + " s: it must be 0 or greater";
            if (!IsAmount(jitter)) return "network jitter is " + jitter + " s: it must be 0 or greater";
            if (!(burstShare >= 0 && burstShare < 1)) return "network burst share is " + burstShare + ": it must be at least 0 and less than 1";
            var shortest = Math.Max(1, burstShare / (1 - burstShare));
            // Without the tolerance, 4 would be too short for a share of 0.8, because 0.8 / (1 - 0.8) is 4.000000000000001.
            if (!(burstLength >= 1 && burstLength * (1 + 1e-9) >= shortest) || double.IsInfinity(burstLength))
                return "network burst length is " + burstLength + ": with a burst share of " + burstShare + " it must be at least " + shortest;
            if (!(burstLoss >= 0 && burstLoss <= 1)) return "network burst loss is " + burstLoss + ": it must be from 0 to 1";
            return FindRetentionProblem(retention, deltaTime);
        }

        // The tolerance is for a retention such as 1/60 that has more digits than the delta time, which is rounded to seven.
        internal static string FindRetentionProblem(double retention, double deltaTime) =>
            IsAmount(retention) && (retention == 0 || retention * (1 + 1e-6) >= deltaTime) ? null
                : "network retention is " + retention + " s: it must be 0 (until the next message) or at least the delta time, " + deltaTime
                    + " s, otherwise messages expire before they are read";

        private static bool IsAmount(double value) => value >= 0 && !double.IsInfinity(value);
    }

    /// <summary>Message counts of one tick.</summary>
    public readonly struct NetworkCounts
    {
        /// <summary>Creates the counts of a tick.</summary>
        internal NetworkCounts(int sent, int dropped, int delayed, int expired)
        {
            Sent = sent;
            Dropped = dropped;
            Delayed = delayed;
            Expired = expired;
        }

        /// <summary>Number of sent messages, one per link.</summary>
        public int Sent { get; }

        /// <summary>Number of <see cref="Sent"/> messages that were lost.</summary>
        public int Dropped { get; }

        /// <summary>Number of <see cref="Sent"/> messages that arrive later than in an ideal network.</summary>
        public int Delayed { get; }

        /// <summary>Number of received messages that expired.</summary>
        public int Expired { get; }
    }
}
