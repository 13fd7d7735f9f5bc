using System;

namespace Collektive.Unity.Editor
{
    /// <summary>A tool is missing or failed; the message explains how to fix it.</summary>
    internal sealed class ToolException : Exception
    {
        internal ToolException(string message) : base(message)
        {
        }
    }
}
