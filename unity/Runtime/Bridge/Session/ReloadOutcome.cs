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

        /// <summary>The reason why the nodes keep their previous programs; empty if they run the new ones.</summary>
        public string Error { get; }

        /// <summary>Number of values that the nodes had stored, counted once for each node and path.</summary>
        public int Stored { get; }

        /// <summary>Number of these values that the new programs can read.</summary>
        public int Kept { get; }
    }
}
