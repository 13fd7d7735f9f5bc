using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A serialised field that the inspector shows, but lets nobody change: for values that a script computes while it runs.</summary>
    public sealed class ReadOnlyAttribute : PropertyAttribute
    {
    }
}
