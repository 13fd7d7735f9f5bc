using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace Collektive.Samples.GradientAscent
{
    /// <summary>Perceives the intensity of a source at the node.</summary>
    [AddComponentMenu("Collektive/Samples/Intensity Sensor")]
    public sealed class IntensitySensor : Sensor<SensorDataDraft>
    {
        [SerializeField]
        [Tooltip("The source to perceive.")]
        private IntensitySource source;

        /// <summary>The source to perceive.</summary>
        public IntensitySource Source
        {
            get => source;
            set => source = value;
        }

        /// <inheritdoc/>
        protected override void Sense(ref SensorDataDraft data)
        {
            data.Intensity = source.IntensityAt(transform.position);
        }
    }
}
