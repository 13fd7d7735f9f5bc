namespace Collektive.Bridge
{
    /// <summary>A problem of the JVM settings, as a message for users.</summary>
    internal readonly struct JvmProblem
    {
        /// <summary>Creates a problem with the setting <paramref name="key"/>.</summary>
        internal JvmProblem(string key, string message)
        {
            Key = key;
            Message = message;
        }

        /// <summary>The field of <see cref="JvmSettings"/> that the problem concerns.</summary>
        internal string Key { get; }

        /// <summary>The error and its fix.</summary>
        internal string Message { get; }

        /// <inheritdoc/>
        public override string ToString() => Key + ": " + Message;
    }
}
