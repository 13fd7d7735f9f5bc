using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Waits for the build of programs when Play is pressed. If the build fails, the settings decide whether Play starts with the previous programs.
    /// </summary>
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
            if (change != PlayModeStateChange.ExitingEditMode) return;
            var canPlay = ToolsMenu.TryRun(() =>
            {
                var failed = ProgramBuild.Refresh(SchemaProject.FindAll().FindAll(project => project.IsUsed));
                return failed.Count == 0 || MayPlay(failed[0]);
            });
            if (canPlay && EditorApplication.isCompiling)
                Debug.LogWarning("the C# of a schema changed: press Play again when Unity has compiled it");
            if (!canPlay || EditorApplication.isCompiling) EditorApplication.isPlaying = false;
        }

        private static bool MayPlay(SchemaProject project)
        {
            switch (ProjectSettings.instance.whenProgramsFail)
            {
                case WhenProgramsFail.Always:
                    Debug.LogWarning(project.Jar + " is older than its sources because the build failed: fix the errors above");
                    return true;
                case WhenProgramsFail.Ask when !Application.isBatchMode:
                    return EditorUtility.DisplayDialog("Collektive", "The programs of " + project.Schema
                        + " were not compiled after the last change. The Console shows the reason.", "Play Previous Programs", "Cancel");
                default:
                    Debug.LogError("Play was not started because the programs of " + project.Schema + " were not compiled after the last change: fix the "
                        + "errors above, or change Play Previous Programs in Project Settings > Collektive");
                    return false;
            }
        }
    }
}
