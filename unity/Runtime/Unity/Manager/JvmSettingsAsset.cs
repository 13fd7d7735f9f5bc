using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>JVM settings as an asset of the project, for all scenes that want the same JVM.</summary>
    [CreateAssetMenu(menuName = "Collektive/JVM Settings", fileName = "JvmSettings")]
    public sealed class JvmSettingsAsset : ScriptableObject
    {
        /// <summary>The settings; <see cref="JvmSetting.All"/> has their labels, units, ranges and tooltips.</summary>
        [Tooltip("Settings for the start of the JVM.")]
        public JvmSettings settings = new JvmSettings();
    }
}
