using Collektive.Unity;
using leaderelection;
using UnityEngine;

namespace CollektiveSamples.LeaderElection
{
    /// <summary>Measures the node's position.</summary>
    [AddComponentMenu("Collektive/Samples/Leader Election/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Vector3 position) => data.Position = position;
    }
}
