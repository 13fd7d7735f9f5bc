using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Colours warned walkers red, and other walkers by the density around them.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Warning Colour")]
    public sealed class WarningColour : ColourActuator<ActuatorData>
    {
        private static readonly Color Free = new Color(0.3f, 0.6f, 0.9f);
        private static readonly Color Dense = new Color(1, 0.8f, 0.2f);

        /// <inheritdoc/>
        protected override Color Read(ActuatorData data) => data.Warned ? Color.red : Color.Lerp(Free, Dense, data.Density);
    }
}
