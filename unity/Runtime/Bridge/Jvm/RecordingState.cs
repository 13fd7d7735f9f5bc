namespace Collektive.Bridge
{
    /// <summary>State of a flight recording of the JVM.</summary>
    public enum RecordingState : byte
    {
        /// <summary>No recording is running.</summary>
        Off = org.collektive.frame.RecordingState.Off,

        /// <summary>A recording is being started.</summary>
        Starting = org.collektive.frame.RecordingState.Starting,

        /// <summary>A recording is running.</summary>
        On = org.collektive.frame.RecordingState.On,

        /// <summary>A recording is running, and its events so far are being written.</summary>
        Dumping = org.collektive.frame.RecordingState.Dumping,

        /// <summary>A recording is being stopped and written.</summary>
        Stopping = org.collektive.frame.RecordingState.Stopping,
    }
}
