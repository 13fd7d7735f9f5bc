using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>Measures the intensity of a source at the node.</summary>
    [AddComponentMenu("Collektive/Samples/Gradient Ascent/Intensity Sensor")]
    public sealed class IntensitySensor : IntensitySensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, float intensity) => data.Intensity = intensity;
    }
}
