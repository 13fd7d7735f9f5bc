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
            settings.jdk = EditorGUILayout.TextField(new GUIContent("JDK", "Root folder of a JDK 17 or newer. Empty: JAVA_HOME, or the newest installed JDK."),
                settings.jdk);
            Show(Toolchain.FindJdk);
            settings.kotlin = EditorGUILayout.TextField(new GUIContent("Kotlin compiler",
                "Folder kotlinc of a Kotlin compiler. Empty: KOTLIN_HOME, or the compiler on PATH."), settings.kotlin);
            Show(() => Toolchain.FindKotlin(AggregateRuntime.BuiltIn));
            settings.buildBeforePlay = EditorGUILayout.Toggle(
                new GUIContent("Build before Play", "Build programs with changed Kotlin or schema when Play is pressed."), settings.buildBeforePlay);
            settings.sourceCheckout = EditorGUILayout.TextField(
                new GUIContent("Source checkout",
                    "Root folder of a clone of the package's repository, for Tools > Collektive > Rebuild Backend. Most projects leave it empty."),
                    settings.sourceCheckout);
            if (EditorGUI.EndChangeCheck()) settings.Store();
        }

        /// <summary>Shows the found tool, or the error.</summary>
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
