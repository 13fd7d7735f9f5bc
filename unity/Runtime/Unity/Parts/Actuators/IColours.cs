using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The non-generic interface of <see cref="ColourActuator{TData}"/>.</summary>
    internal interface IColours
    {
        /// <summary>The coloured renderer, or null.</summary>
        Renderer Target { get; }
    }
}
