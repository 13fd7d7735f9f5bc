using System;

namespace Collektive.Unity.Editor
{
    /// <summary>An error of a tool that is missing or has failed. The message explains how to fix it.</summary>
    internal sealed class ToolException : Exception
    {
        internal ToolException(string message) : base(message)
        {
        }
    }
}
