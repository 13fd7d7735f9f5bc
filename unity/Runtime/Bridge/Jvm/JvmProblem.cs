namespace Collektive.Bridge
{
    /// <summary>Something that is wrong with JVM settings, for the user who set them.</summary>
    internal readonly struct JvmProblem
    {
        /// <summary>Makes a problem of the setting <paramref name="key"/>.</summary>
        internal JvmProblem(string key, string message)
        {
            Key = key;
            Message = message;
        }

        /// <summary>The field of <see cref="JvmSettings"/> to show it at.</summary>
        internal string Key { get; }

        /// <summary>What is wrong, and what to do.</summary>
        internal string Message { get; }

        /// <inheritdoc/>
        public override string ToString() => Key + ": " + Message;
    }
}
