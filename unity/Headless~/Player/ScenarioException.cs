using System;

namespace Collektive.Headless
{
    /// <summary>An error in the user's input. The message explains the error and how to correct it.</summary>
    public sealed class ScenarioException : Exception
    {
        /// <summary>Creates an exception with a one-line message.</summary>
        public ScenarioException(string message) : base(message)
        {
        }
    }
}
