using System;

namespace Collektive.Bridge
{
    /// <summary>
    /// Keeps a class that nothing names in code, such as a generated schema, in a player whose unused code is stripped. Unity goes by the attribute's
    /// name; this one is for code that does not refer to the engine.
    /// </summary>
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class PreserveAttribute : Attribute
    {
    }
}
