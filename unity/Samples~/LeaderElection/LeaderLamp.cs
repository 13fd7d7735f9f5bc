using Collektive.Unity;
using leaderelection;
using UnityEngine;

namespace CollektiveSamples.LeaderElection
{
    /// <summary>Shows a lamp above each leader.</summary>
    [AddComponentMenu("Collektive/Samples/Leader Election/Leader Lamp")]
    public sealed class LeaderLamp : EnableActuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override bool Read(ActuatorData data) => data.Leader == Node.Id;
    }
}
