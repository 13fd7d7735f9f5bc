using Collektive.Unity;
using rescue;
using UnityEngine;

namespace Collektive.Samples.Rescue
{
    /// <summary>Perceives where the robot is.</summary>
    [AddComponentMenu("Collektive/Samples/Rescue/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Vector3 position) => data.Position = position.ToValue();
    }
}
