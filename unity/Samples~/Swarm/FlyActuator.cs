using Collektive.Unity;
using drones;
using UnityEngine;

namespace CollektiveSamples.Swarm
{
    /// <summary>Moves the drone towards the program's target.</summary>
    [AddComponentMenu("Collektive/Samples/Swarm/Fly Actuator")]
    public sealed class FlyActuator : MoveActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override Vector3 Read(ActuatorData data) => data.Target;
    }
}
