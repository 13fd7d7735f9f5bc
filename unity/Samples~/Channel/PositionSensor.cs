using Collektive.Unity;
using channel;
using UnityEngine;

namespace CollektiveSamples.Channel
{
    /// <summary>Measures the node's position.</summary>
    [AddComponentMenu("Collektive/Samples/Channel/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Vector3 position) => data.Position = position;
    }
}
