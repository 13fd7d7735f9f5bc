using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Builds programs with changed sources when Play is pressed.</summary>
    internal static class BuildBeforePlay
    {
        [InitializeOnLoadMethod]
        private static void Listen()
        {
            EditorApplication.playModeStateChanged -= Changed;
            EditorApplication.playModeStateChanged += Changed;
        }

        private static void Changed(PlayModeStateChange change)
        {
            if (change != PlayModeStateChange.ExitingEditMode || !ProjectSettings.instance.buildBeforePlay) return;
            var manager = Object.FindAnyObjectByType<SimulationManager>();
            if (manager == null) return;
            foreach (var jar in ProgramBuild.Refresh(manager.Settings))
                Debug.LogWarning(jar + " is older than its sources because the build failed: fix the errors above", manager);
        }
    }
}
