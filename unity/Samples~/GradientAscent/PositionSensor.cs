using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>Measures the node's position.</summary>
    [AddComponentMenu("Collektive/Samples/Gradient Ascent/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Vector3 position) => data.Position = position;
    }
}
