using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Makes a serialised field read-only in the inspector. Use it for values that a script computes.</summary>
    public sealed class InspectorReadOnlyAttribute : PropertyAttribute
    {
        /// <summary>Creates the attribute. On a list, it applies to the list as a whole, which then cannot be resized.</summary>
        public InspectorReadOnlyAttribute() : base(true)
        {
        }
    }
}
