using System;
using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>
    /// Keeps a class without references in code, such as a generated schema, in players with code stripping. Unity recognises the attribute by its
    /// name; this one is for code that does not refer to the engine.
    /// </summary>
    [AttributeUsage(AttributeTargets.Class)]
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class PreserveAttribute : Attribute
    {
    }
}
