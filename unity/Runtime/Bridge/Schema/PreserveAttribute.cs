using System;
using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>
    /// Prevents code stripping from removing a class that no code references, such as a generated schema. Unity recognises the attribute by its name, so
    /// this class replaces Unity's in code that does not reference the engine.
    /// </summary>
    [AttributeUsage(AttributeTargets.Class)]
    [EditorBrowsable(EditorBrowsableState.Never)]
    public sealed class PreserveAttribute : Attribute
    {
    }
}
