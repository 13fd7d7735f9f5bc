using System.Diagnostics;

namespace Collektive.Unity
{
    /// <summary>Durations of the phases of a tick, in milliseconds.</summary>
    public readonly struct TickTimes
    {
        /// <summary>Creates the durations of one tick.</summary>
        internal TickTimes(double queries, double rules, double sense, double step, double act, double physics)
        {
            Queries = queries;
            Rules = rules;
            Sense = sense;
            Step = step;
            Act = act;
            Physics = physics;
        }

        /// <summary>The record of a tick, from readings of <see cref="Stopwatch"/> at its start and at the end of each phase.</summary>
        internal static TickTimes Of(long start, long queriesEnd, long rulesEnd, long senseEnd, long stepEnd, long actEnd, long end) =>
            new TickTimes(
                Milliseconds(start, queriesEnd), Milliseconds(queriesEnd, rulesEnd), Milliseconds(rulesEnd, senseEnd), Milliseconds(senseEnd, stepEnd),
                Milliseconds(stepEnd, actEnd), Milliseconds(actEnd, end));

        /// <summary>Changes of nodes, positions, the choice of due nodes, and the start of physics queries.</summary>
        public double Queries { get; }

        /// <summary>Neighbourhood rules.</summary>
        public double Rules { get; }

        /// <summary>Sensors, and the links that changed.</summary>
        public double Sense { get; }

        /// <summary>The frame, the call into the JVM and all rounds.</summary>
        public double Step { get; }

        /// <summary>Actuators.</summary>
        public double Act { get; }

        /// <summary>All physics sub-steps.</summary>
        public double Physics { get; }

        /// <summary>The whole tick, without handlers of <see cref="SimulationManager.Ticked"/> and the rest of Unity's frame.</summary>
        public double Total => Queries + Rules + Sense + Step + Act + Physics;

        private static double Milliseconds(long from, long to) => (to - from) * 1000.0 / Stopwatch.Frequency;
    }
}
