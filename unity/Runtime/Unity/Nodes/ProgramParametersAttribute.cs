using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Makes the inspector show a list of values as one field per parameter of the node's program.</summary>
    internal sealed class ProgramParametersAttribute : PropertyAttribute
    {
        internal ProgramParametersAttribute() : base(true)
        {
        }
    }
}
