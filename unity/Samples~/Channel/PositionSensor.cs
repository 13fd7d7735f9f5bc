using Collektive.Unity;
using channel;
using UnityEngine;

namespace Collektive.Samples.Channel
{
    /// <summary>Perceives where the node is.</summary>
    [AddComponentMenu("Collektive/Samples/Channel/Position Sensor")]
    public sealed class PositionSensor : PositionSensor<SensorDataValue>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorDataValue data, Vector3 position) => data.Position = position.ToValue();
    }
}
