using Collektive.Unity;
using channel;
using UnityEngine;

namespace CollektiveSamples.Channel
{
    /// <summary>Colours nodes by whether they are part of the channel.</summary>
    [AddComponentMenu("Collektive/Samples/Channel/Channel Colour")]
    public sealed class ChannelColour : ColourActuator<ActuatorData>
    {
        private static readonly Color In = new Color(1, 0.8f, 0.2f);
        private static readonly Color Out = new Color(0.3f, 0.35f, 0.5f);

        /// <inheritdoc/>
        protected override Color Read(ActuatorData data) => data.InChannel ? In : Out;
    }
}
