using Collektive.Unity;
using leaderelection;
using UnityEngine;

namespace CollektiveSamples.LeaderElection
{
    /// <summary>Gives all nodes of one leader the same colour.</summary>
    [AddComponentMenu("Collektive/Samples/Leader Election/Leader Colour")]
    public sealed class LeaderColour : ColourActuator<ActuatorData>
    {
        /// <summary>A hue in 0..1, far from those of neighbouring ids.</summary>
        public static float HueOf(int leader) => leader * 0.61803399f % 1;

        /// <inheritdoc/>
        protected override Color Read(ActuatorData data) => Color.HSVToRGB(HueOf(data.Leader), 0.7f, 1);
    }
}
