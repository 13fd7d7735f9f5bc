using Collektive.Unity;
using leaderelection;
using UnityEngine;

namespace CollektiveSamples.LeaderElection
{
    /// <summary>Sets the same colour on all nodes with the same leader.</summary>
    [AddComponentMenu("Collektive/Samples/Leader Election/Leader Colour")]
    public sealed class LeaderColour : ColourActuator<ActuatorData>
    {
        /// <summary>Returns a hue from 0 to 1. The hues of leaders with similar ids differ strongly.</summary>
        public static float HueOf(int leader) => leader * 0.61803399f % 1;

        /// <inheritdoc/>
        protected override Color Read(ActuatorData data) => Color.HSVToRGB(HueOf(data.Leader), 0.7f, 1);
    }
}
