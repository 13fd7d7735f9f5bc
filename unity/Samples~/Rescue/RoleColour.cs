using Collektive.Unity;
using rescue;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>Colours each robot by its role.</summary>
    [AddComponentMenu("Collektive/Samples/Rescue/Role Colour")]
    public sealed class RoleColour : ColourActuator<ActuatorData>
    {
        private static readonly Color[] Colors =
        {
            new Color(0.35f, 0.5f, 0.7f), new Color(1, 0.75f, 0.15f), new Color(0.9f, 0.2f, 0.25f), new Color(0.2f, 0.65f, 0.35f),
        };

        /// <summary>Names of the roles, by their numbers.</summary>
        public static readonly string[] Names = { "explores", "part of a channel", "with a casualty", "base" };

        /// <inheritdoc/>
        protected override Color Read(ActuatorData data) => Colors[data.Role];
    }
}
