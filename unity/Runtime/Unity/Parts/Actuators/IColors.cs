using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>What a <see cref="ColorActuator{TData}"/> is, whatever its data.</summary>
    internal interface IColors
    {
        /// <summary>What is coloured; null: nothing yet.</summary>
        Renderer Target { get; }
    }
}
