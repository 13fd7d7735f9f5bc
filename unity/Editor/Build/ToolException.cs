using System;

namespace Collektive.Unity.Editor
{
    /// <summary>A tool is missing or cannot do its work; the message says what to do.</summary>
    internal sealed class ToolException : Exception
    {
        internal ToolException(string message) : base(message)
        {
        }
    }
}
