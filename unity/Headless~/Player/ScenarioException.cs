using System;

namespace Collektive.Headless
{
    /// <summary>An error in the user's input. The message explains it and how to fix it.</summary>
    public sealed class ScenarioException : Exception
    {
        /// <summary>Creates an exception with a one-line message.</summary>
        public ScenarioException(string message) : base(message)
        {
        }
    }
}
