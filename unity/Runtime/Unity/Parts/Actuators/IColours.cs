using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The part of <see cref="ColourActuator{TData}"/> that does not depend on the schema's type.</summary>
    internal interface IColours
    {
        /// <summary>The coloured renderer, or null.</summary>
        Renderer Target { get; }
    }
}
