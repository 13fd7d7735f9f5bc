using Collektive.Unity;
using drones;
using UnityEngine;

namespace CollektiveSamples.Swarm
{
    /// <summary>Measures the drone's position.</summary>
    [AddComponentMenu("Collektive/Samples/Swarm/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Vector3 position) => data.Position = position;
    }
}
