using Collektive.Unity;
using crowd;
using UnityEngine;

namespace Collektive.Samples.Crowd
{
    /// <summary>Walks as the program says.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Walk Actuator")]
    public sealed class WalkActuator : SetVelocityActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override Vector3 Read(ActuatorData data) => data.Velocity.ToUnity();
    }
}
