namespace Collektive.Bridge
{
    /// <summary>The outcome of replacing the programs of a session.</summary>
    internal readonly struct ReloadOutcome
    {
        internal ReloadOutcome(string error, int stored, int kept)
        {
            Error = error ?? "";
            Stored = stored;
            Kept = kept;
        }

        /// <summary>Why the nodes keep their previous programs; empty when they have the new ones.</summary>
        public string Error { get; }

        /// <summary>Number of values that nodes had stored, one for each node and path.</summary>
        public int Stored { get; }

        /// <summary>Number of these values that the new programs can read.</summary>
        public int Kept { get; }
    }
}
