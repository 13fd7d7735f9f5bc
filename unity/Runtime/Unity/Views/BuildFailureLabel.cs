using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Shows a message in the Game view while nodes run the previous programs because the last build failed.</summary>
    [AddComponentMenu("")]
    internal sealed class BuildFailureLabel : MonoBehaviour
    {
        private const string Text = "The programs were not compiled; the previous ones continue. The Console has the errors.";

        private static BuildFailureLabel shown;

        /// <summary>Shows or removes the label. It is also removed with its scene.</summary>
        internal static void Show(bool hasFailed)
        {
            if (hasFailed == (shown != null)) return;
            if (hasFailed) new GameObject("Build Failure Label") { hideFlags = HideFlags.HideInHierarchy }.AddComponent<BuildFailureLabel>();
            else Destroy(shown.gameObject);
        }

        // A reload of code during Play clears the static field, but keeps the label.
        private void OnEnable() => shown = this;

        private void OnDisable() => Legends.Remove(this);

        private void OnGUI() => GUI.Label(Legends.PlaceOf(this), Text);
    }
}
