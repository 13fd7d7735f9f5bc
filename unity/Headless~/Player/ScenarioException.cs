using System;

namespace Collektive.Headless
{
    /// <summary>Something that the user gave is wrong; the message says what and what to do.</summary>
    public sealed class ScenarioException : Exception
    {
        /// <summary>Makes an exception with its one-line message.</summary>
        public ScenarioException(string message) : base(message)
        {
        }
    }
}
