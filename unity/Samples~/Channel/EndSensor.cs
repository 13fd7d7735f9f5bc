using Collektive.Unity;
using channel;
using UnityEngine;

namespace CollektiveSamples.Channel
{
    /// <summary>Writes to the sensor data whether the channel begins or ends at the node.</summary>
    [AddComponentMenu("Collektive/Samples/Channel/End Sensor")]
    public sealed class EndSensor : Sensor<SensorData>
    {
        [SerializeField]
        [Tooltip("On: the channel starts at this node.")]
        private bool source;

        [SerializeField]
        [Tooltip("On: the channel ends at this node.")]
        private bool target;

        /// <summary>Whether the channel begins at this node.</summary>
        public bool Source
        {
            get => source;
            set => source = value;
        }

        /// <summary>Whether the channel ends at this node.</summary>
        public bool Target
        {
            get => target;
            set => target = value;
        }

        /// <inheritdoc/>
        protected override void Sense(ref SensorData data)
        {
            data.Source = source;
            data.Target = target;
        }
    }
}
