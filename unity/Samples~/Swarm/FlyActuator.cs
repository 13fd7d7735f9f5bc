using Collektive.Unity;
using drones;
using UnityEngine;

namespace CollektiveSamples.Swarm
{
    /// <summary>Flies towards the target of the program.</summary>
    [AddComponentMenu("Collektive/Samples/Swarm/Fly Actuator")]
    public sealed class FlyActuator : MoveActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override Vector3 Read(ActuatorData data) => data.Target;
    }
}
