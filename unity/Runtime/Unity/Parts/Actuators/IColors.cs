using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The non-generic interface of <see cref="ColorActuator{TData}"/>.</summary>
    internal interface IColors
    {
        /// <summary>The coloured renderer, or null.</summary>
        Renderer Target { get; }
    }
}
