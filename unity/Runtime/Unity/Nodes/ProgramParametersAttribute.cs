using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Draws a list of values with a field for each parameter of the node's program.</summary>
    internal sealed class ProgramParametersAttribute : PropertyAttribute
    {
        internal ProgramParametersAttribute() : base(true)
        {
        }
    }
}
