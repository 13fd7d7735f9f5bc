using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace Collektive.Samples.GradientAscent
{
    /// <summary>Perceives where the node is.</summary>
    [AddComponentMenu("Collektive/Samples/Gradient Ascent/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorDataDraft>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorDataDraft data, Vector3 position) => data.Position = position.ToValue();
    }
}
