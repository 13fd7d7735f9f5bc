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

        /// <summary>Creates the durations from readings of <see cref="Stopwatch"/> at the start of the tick and at the end of each phase.</summary>
        internal static TickTimes Of(long start, long queriesEnd, long rulesEnd, long senseEnd, long stepEnd, long actEnd, long end) =>
            new TickTimes(
                Milliseconds(start, queriesEnd), Milliseconds(queriesEnd, rulesEnd), Milliseconds(rulesEnd, senseEnd), Milliseconds(senseEnd, stepEnd),
                Milliseconds(stepEnd, actEnd), Milliseconds(actEnd, end));

        /// <summary>Time for changes of nodes, reading positions, selecting due nodes, and starting physics queries.</summary>
        public double Queries { get; }

        /// <summary>Time in neighbourhood rules.</summary>
        public double Rules { get; }

        /// <summary>Time in sensors, and for collecting the links that changed.</summary>
        public double Sense { get; }

        /// <summary>Time for writing the frame and for the call into the JVM with all rounds.</summary>
        public double Step { get; }

        /// <summary>Time in actuators.</summary>
        public double Act { get; }

        /// <summary>Time in all physics sub-steps.</summary>
        public double Physics { get; }

        /// <summary>Time of the whole tick, without handlers of <see cref="SimulationManager.Ticked"/> and the rest of Unity's frame.</summary>
        public double Total => Queries + Rules + Sense + Step + Act + Physics;

        private static double Milliseconds(long from, long to) => (to - from) * 1000.0 / Stopwatch.Frequency;
    }
}
