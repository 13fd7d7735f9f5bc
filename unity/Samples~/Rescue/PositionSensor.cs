using Collektive.Unity;
using rescue;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>Measures the robot's position.</summary>
    [AddComponentMenu("Collektive/Samples/Rescue/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Vector3 position) => data.Position = position;
    }
}
