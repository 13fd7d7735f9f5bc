using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Project Settings &gt; Collektive.</summary>
    internal static class ProjectSettingsPage
    {
        internal const string Path = "Project/Collektive";

        [SettingsProvider]
        private static SettingsProvider Make() =>
            new SettingsProvider(Path, SettingsScope.Project, new[] { "Collektive", "Kotlin", "JDK", "JVM", "program", "schema" })
        {
            label = "Collektive",
            guiHandler = search => Draw(),
        };

        private static void Draw()
        {
            var settings = ProjectSettings.instance;
            EditorGUI.BeginChangeCheck();
            settings.jdk = EditorGUILayout.TextField(new GUIContent("JDK", "Root folder of a JDK 17 or newer. Empty: JAVA_HOME, else the newest one found."),
                settings.jdk);
            Show(Toolchain.FindJdk);
            settings.kotlin = EditorGUILayout.TextField(new GUIContent("Kotlin compiler",
                "The folder kotlinc of a Kotlin compiler. Empty: KOTLIN_HOME, else the one on PATH."), settings.kotlin);
            Show(() => Toolchain.FindKotlin(AggregateRuntime.BuiltIn));
            settings.buildBeforePlay = EditorGUILayout.Toggle(
                new GUIContent("Build before Play", "Programs whose Kotlin or schema changed are built when Play is pressed."), settings.buildBeforePlay);
            settings.sourceCheckout = EditorGUILayout.TextField(
                new GUIContent("Source checkout",
                    "Root folder of the package's own repository, for Tools > Collektive > Rebuild Backend. Most projects have none."),
                    settings.sourceCheckout);
            if (EditorGUI.EndChangeCheck()) settings.Store();
        }

        /// <summary>What was found, or why not.</summary>
        private static void Show(System.Func<string> find)
        {
            try
            {
                EditorGUILayout.LabelField(" ", find());
            }
            catch (ToolException error)
            {
                EditorGUILayout.HelpBox(error.Message, MessageType.Warning);
            }
        }
    }
}
