using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace Collektive.Samples.GradientAscent
{
    /// <summary>Perceives where the node is.</summary>
    [AddComponentMenu("Collektive/Samples/Position Sensor")]
    public sealed class PositionSensor : Sensor<SensorDataDraft>
    {
        /// <inheritdoc/>
        protected override void Sense(ref SensorDataDraft data)
        {
            data.Position = transform.position.ToValue();
        }
    }
}
