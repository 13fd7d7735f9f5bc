using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Builds programs whose sources changed when Play is pressed, so that the next Play runs what was edited.</summary>
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
            var jars = Jars(manager.Settings);
            foreach (var project in SchemaProject.FindAll())
            {
                // An imported sample has sources too, but runs from the package's own jar.
                if (!jars.Contains(project.Jar) || !project.HasPrograms || !project.IsStale) continue;
                if (!ToolsMenu.Guarded(() => ProgramBuild.Make(project)))
                    Debug.LogWarning(project.Jar + " is older than its sources: it could not be built, see above", manager);
            }
        }

        private static List<string> Jars(SimulationSettings settings)
        {
            if (settings.jars.Count > 0) return settings.jars;
            // Play reports what is wrong with the schema.
            var schema = Schemas.TryFind(settings.schema);
            return schema != null ? settings.JarsFor(schema) : settings.jars;
        }
    }
}
