using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The manager's inspector. It shows the settings and, while the simulation runs, a dashboard.</summary>
    [CustomEditor(typeof(SimulationManager))]
    internal sealed class SimulationManagerEditor : UnityEditor.Editor
    {
        private readonly Recorder recorder = new Recorder();
        private UnityEditor.Editor jvm;
        private bool isJvmShown;

        /// <summary>Returns true during play, because the dashboard changes with each tick.</summary>
        public override bool RequiresConstantRepaint() => EditorApplication.isPlaying;

        /// <inheritdoc/>
        public override void OnInspectorGUI()
        {
            var manager = (SimulationManager)target;
            DrawDefaultInspector();
            if (EditorApplication.isPlaying && manager.Programs.Count > 0)
                EditorGUILayout.HelpBox(
                    "Settings take effect at the next Play, changed JVM settings " + Jvm.WhenChangesTakeEffect + ".", MessageType.Info);
            DrawJvm(manager.Settings.jvm);
            if (EditorApplication.isPlaying) DrawDashboard(manager);
        }

        private void OnDisable()
        {
            if (jvm != null) DestroyImmediate(jvm);
        }

        /// <summary>Draws the settings of the JVM asset within the manager's inspector.</summary>
        private void DrawJvm(JvmSettingsAsset asset)
        {
            if (asset == null) return;
            isJvmShown = EditorGUILayout.Foldout(isJvmShown, "JVM settings", true);
            if (!isJvmShown) return;
            if (jvm == null || jvm.target != asset)
            {
                if (jvm != null) DestroyImmediate(jvm);
                jvm = CreateEditor(asset);
            }
            jvm.OnInspectorGUI();
        }

        private void DrawDashboard(SimulationManager manager)
        {
            EditorGUILayout.Space();
            EditorGUILayout.LabelField("Dashboard", EditorStyles.boldLabel);
            foreach (var line in Dashboard.Of(manager)) EditorGUILayout.LabelField(line.Key, line.Value);
            EditorGUILayout.BeginHorizontal();
            if (GUILayout.Button(manager.Paused ? "Resume" : "Pause")) manager.Paused = !manager.Paused;
            if (GUILayout.Button("Step")) Step(manager);
            if (GUILayout.Button("Diagnostics")) DiagnosticsWindow.Open();
            EditorGUILayout.EndHorizontal();
            recorder.Draw();
        }

        /// <summary>Runs one tick and pauses the simulation.</summary>
        private static void Step(SimulationManager manager)
        {
            manager.Paused = true;
            manager.Step();
        }
    }
}
