namespace Collektive.Unity
{
    /// <summary>How long the phases of a tick took, in milliseconds.</summary>
    public readonly struct TickTimes
    {
        /// <summary>Makes a record of one tick.</summary>
        internal TickTimes(double sense, double step, double act, double physics)
        {
            Sense = sense;
            Step = step;
            Act = act;
            Physics = physics;
        }

        /// <summary>Neighbourhood rules and sensors.</summary>
        public double Sense { get; }

        /// <summary>The frame, the call into the JVM and all rounds.</summary>
        public double Step { get; }

        /// <summary>Actuators.</summary>
        public double Act { get; }

        /// <summary>All physics sub-steps.</summary>
        public double Physics { get; }

        /// <summary>The whole tick.</summary>
        public double Total => Sense + Step + Act + Physics;
    }
}
