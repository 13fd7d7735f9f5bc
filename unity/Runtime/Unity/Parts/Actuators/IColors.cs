using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The non-generic interface of <see cref="ColorActuator{TData}"/>.</summary>
    internal interface IColors
    {
        /// <summary>What is coloured; null: nothing yet.</summary>
        Renderer Target { get; }
    }
}
