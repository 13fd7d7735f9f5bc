using System;

namespace Collektive.Headless.Bench
{
    /// <summary>An error that stops the benchmark, with a message for the user.</summary>
    internal sealed class BenchException : Exception
    {
        internal BenchException(string message) : base(message)
        {
        }
    }
}
