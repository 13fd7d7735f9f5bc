using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>JVM settings as an asset, shared by scenes.</summary>
    [CreateAssetMenu(menuName = "Collektive/JVM Settings", fileName = "JvmSettings")]
    [HelpPage("jvm-and-jfr.md#settings")]
    public sealed class JvmSettingsAsset : ScriptableObject
    {
        /// <summary>The settings; <see cref="JvmSetting.All"/> has their labels, units, ranges and tooltips.</summary>
        [Tooltip("Settings for the start of the JVM.")]
        public JvmSettings settings = new JvmSettings();
    }
}
