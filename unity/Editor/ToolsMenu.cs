using System;
using System.Collections.Generic;
using System.IO;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The menu Tools &gt; Collektive.</summary>
    internal static class ToolsMenu
    {
        private const string Menu = "Tools/Collektive/";

        [MenuItem(Menu + "Generate Schema Code", false, 1)]
        private static void GenerateSchemaCode()
        {
            var projects = FindAll("Generating code", project => true);
            if (projects.Count == 0) return;
            TryRun(() =>
            {
                for (var i = 0; i < projects.Count; i++)
                {
                    EditorUtility.DisplayProgressBar("Collektive: Generating code", projects[i].Schema, (float)i / projects.Count);
                    if (SchemaCode.MakeCSharp(projects[i])) Debug.Log(projects[i].Schema + ": C# in " + projects[i].Generated);
                }
                AssetDatabase.Refresh();
                return true;
            });
        }

        [MenuItem(Menu + "Rebuild Programs", false, 2)]
        private static void RebuildPrograms() => ProgramBuild.Start(FindAll("Building programs", project => project.HasPrograms));

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

        [MenuItem(Menu + "Write Gradle Build", false, 4)]
        private static void WriteGradleBuild()
        {
            var projects = FindAll("Writing the Gradle build", project => project.HasPrograms && project.Runtime.Kind == AggregateRuntime.BuiltIn);
            if (projects.Count == 0) return;
            TryRun(() =>
            {
                GradleBuild.Write(projects);
                Debug.Log("Gradle build for IDEs: open the folder " + GradleBuild.Folder + " in IntelliJ IDEA or VS Code");
                return true;
            });
        }

        [MenuItem(Menu + "Tutorial", false, 40)]
        private static void OpenTutorial() => Application.OpenURL(Installation.AddressOf("first-swarm-in-unity.md"));

        [MenuItem(Menu + "Diagnostics", false, 20)]
        private static void OpenDiagnostics() => DiagnosticsWindow.Open();

        [MenuItem(Menu + "Open Log", false, 21)]
        private static void OpenLog()
        {
            var log = Application.consoleLogPath;
            if (string.IsNullOrEmpty(log)) Debug.LogWarning("this editor does not write a log file");
            else EditorUtility.RevealInFinder(log);
        }

        /// <summary>Runs a build step, and logs an error if a tool is missing or a file cannot be read.</summary>
        internal static bool TryRun(Func<bool> step)
        {
            try
            {
                return step();
            }
            catch (Exception error) when (error is ToolException || error is IOException || error is UnauthorizedAccessException)
            {
                Debug.LogError(error.Message);
                return false;
            }
            finally
            {
                EditorUtility.ClearProgressBar();
            }
        }

        private static List<SchemaProject> FindAll(string title, Predicate<SchemaProject> isWanted)
        {
            var projects = SchemaProject.FindAll().FindAll(isWanted);
            if (projects.Count == 0)
                Debug.LogWarning(title
                    + ": no sources were found. Put schemas (*.fbs) below Assets, and their programs (*.kt) into a Programs folder next to them");
            return projects;
        }
    }
}
