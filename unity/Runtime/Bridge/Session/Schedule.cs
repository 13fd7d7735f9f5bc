namespace Collektive.Bridge
{
    /// <summary>Order of rounds, and the messages that a round receives.</summary>
    public enum Schedule : byte
    {
        /// <summary>All due nodes receive messages from before this tick. Rounds run in parallel.</summary>
        Lockstep = org.collektive.frame.Schedule.Lockstep,

        /// <summary>Due nodes run in the order of ids, and also receive messages of this tick.</summary>
        Sequential = org.collektive.frame.Schedule.Sequential,

        /// <summary>Each node is due at its own times. All due nodes receive messages from before this tick.</summary>
        Asynchronous = org.collektive.frame.Schedule.Asynchronous,
    }
}
