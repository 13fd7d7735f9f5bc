using System;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The menu Tools &gt; Collektive.</summary>
    internal static class ToolsMenu
    {
        private const string Menu = "Tools/Collektive/";

        [MenuItem(Menu + "Generate Schema Code", false, 1)]
        private static void GenerateSchemaCode() =>
            ForEach("Generating code", project => true, SchemaCode.MakeCSharp, project => project.Schema + ": C# in " + project.Generated);

        [MenuItem(Menu + "Rebuild Programs", false, 2)]
        private static void RebuildPrograms() =>
            ForEach("Building programs", project => project.HasPrograms, ProgramBuild.Make, project => project.Programs + ": " + project.Jar);

        [MenuItem(Menu + "Rebuild Backend", false, 3)]
        private static void RebuildBackend()
        {
            TryRun(() =>
            {
                EditorUtility.DisplayProgressBar("Collektive", "Building the package from its sources", 0.5f);
                var archive = BackendBuild.Make();
                if (archive != null)
                    Debug.Log("built " + archive
                        + ": install it with Package Manager > + > Install package from tarball, then restart the editor "
                        + "(until then it uses the old backend)");
                return archive != null;
            });
        }

        [MenuItem(Menu + "Diagnostics", false, 20)]
        private static void OpenDiagnostics() => DiagnosticsWindow.Open();

        [MenuItem(Menu + "Open Log", false, 21)]
        private static void OpenLog()
        {
            var log = Application.consoleLogPath;
            if (string.IsNullOrEmpty(log)) Debug.LogWarning("this editor does not write a log file");
            else EditorUtility.RevealInFinder(log);
        }

        /// <summary>Runs a build step, and logs an error if a tool is missing.</summary>
        internal static bool TryRun(Func<bool> step)
        {
            try
            {
                return step();
            }
            catch (ToolException error)
            {
                Debug.LogError(error.Message);
                return false;
            }
            finally
            {
                EditorUtility.ClearProgressBar();
            }
        }

        private static void ForEach(string title, Predicate<SchemaProject> isWanted, Func<SchemaProject, bool> make, Func<SchemaProject, string> done)
        {
            var projects = SchemaProject.FindAll(ProgramRuntime.OfScene()).FindAll(isWanted);
            if (projects.Count == 0)
            {
                Debug.LogWarning(title
                    + ": no sources were found. Put schemas (*.fbs) below Assets, and their programs (*.kt) into the folder Programs beside them");
                return;
            }
            TryRun(() =>
            {
                for (var i = 0; i < projects.Count; i++)
                {
                    EditorUtility.DisplayProgressBar("Collektive: " + title, projects[i].Schema, (float)i / projects.Count);
                    if (make(projects[i])) Debug.Log(done(projects[i]));
                }
                AssetDatabase.Refresh();
                return true;
            });
        }
    }
}
