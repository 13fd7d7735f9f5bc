using System;

namespace Collektive.Headless.Bench
{
    /// <summary>An error that prevents the benchmark. The message is for its user.</summary>
    internal sealed class BenchException : Exception
    {
        internal BenchException(string message) : base(message)
        {
        }
    }
}
