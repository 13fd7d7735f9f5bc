using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Makes a serialised field read-only in the inspector, for values that a script computes.</summary>
    public sealed class ReadOnlyAttribute : PropertyAttribute
    {
    }
}
