namespace Collektive.Bridge
{
    /// <summary>Which messages a round sees, and when nodes are due.</summary>
    public enum Schedule : byte
    {
        /// <summary>All due nodes read what was sent before this tick; rounds run in parallel.</summary>
        Lockstep = org.collektive.frame.Schedule.Lockstep,

        /// <summary>Due nodes run in id order; each sees what earlier nodes sent in the same tick.</summary>
        Sequential = org.collektive.frame.Schedule.Sequential,

        /// <summary>Each node is due at its own times; all due nodes read what was sent before this tick.</summary>
        Asynchronous = org.collektive.frame.Schedule.Asynchronous,
    }
}
