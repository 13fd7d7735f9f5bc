using Collektive.Unity;
using rescue;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>Drives the robot at the program's velocity.</summary>
    [AddComponentMenu("Collektive/Samples/Rescue/Drive Actuator")]
    public sealed class DriveActuator : SetVelocityActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override Vector3 Read(ActuatorData data) => data.Velocity;
    }
}
