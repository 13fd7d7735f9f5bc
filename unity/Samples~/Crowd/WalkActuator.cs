using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Moves the walker at the program's velocity.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Walk Actuator")]
    public sealed class WalkActuator : SetVelocityActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override Vector3 Read(ActuatorData data) => data.Velocity;
    }
}
