namespace Collektive.Bridge
{
    /// <summary>State of a flight recording of the JVM.</summary>
    public enum RecordingState : byte
    {
        /// <summary>None runs.</summary>
        Off = org.collektive.frame.RecordingState.Off,

        /// <summary>It is being started.</summary>
        Starting = org.collektive.frame.RecordingState.Starting,

        /// <summary>It runs.</summary>
        On = org.collektive.frame.RecordingState.On,

        /// <summary>It runs, and its events so far are being written.</summary>
        Dumping = org.collektive.frame.RecordingState.Dumping,

        /// <summary>It is being stopped and written.</summary>
        Stopping = org.collektive.frame.RecordingState.Stopping,
    }
}
