using System;

namespace Collektive.Headless.Bench
{
    /// <summary>Why the benchmark cannot run, for its user.</summary>
    internal sealed class BenchException : Exception
    {
        internal BenchException(string message) : base(message)
        {
        }
    }
}
