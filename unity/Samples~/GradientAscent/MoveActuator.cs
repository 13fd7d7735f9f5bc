using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>Drives the node's rigid body towards the program's target.</summary>
    [AddComponentMenu("Collektive/Samples/Gradient Ascent/Move Actuator")]
    public sealed class MoveActuator : MoveActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override Vector3 Read(ActuatorData data) => data.Target;
    }
}
