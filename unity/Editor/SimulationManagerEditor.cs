using System;
using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The manager's inspector: its settings, the programs to choose from, and a dashboard while it runs.</summary>
    [CustomEditor(typeof(SimulationManager))]
    internal sealed class SimulationManagerEditor : UnityEditor.Editor
    {
        private const string KnownPrograms = "Collektive.Programs";

        private readonly Recorder recorder = new Recorder();
        private UnityEditor.Editor jvm;
        private bool isJvmShown;

        /// <summary>The dashboard changes with each tick.</summary>
        public override bool RequiresConstantRepaint() => EditorApplication.isPlaying;

        /// <inheritdoc/>
        public override void OnInspectorGUI()
        {
            var manager = (SimulationManager)target;
            var isRunning = EditorApplication.isPlaying && manager.Programs.Count > 0;
            if (isRunning) Remember(manager);
            DrawDefaultInspector();
            if (isRunning) EditorGUILayout.HelpBox("Settings take effect at the next Play. Changed JVM options and another JVM need a restart of the editor.",
                MessageType.Info);
            else DrawPrograms();
            DrawJvm(manager.Settings.jvm);
            if (EditorApplication.isPlaying) DrawDashboard(manager);
        }

        private void OnDisable()
        {
            if (jvm != null) DestroyImmediate(jvm);
        }

        /// <summary>The settings of the asset that the manager names, in place.</summary>
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

        private void DrawPrograms()
        {
            var names = SessionState.GetString(KnownPrograms, "");
            if (names.Length == 0)
            {
                EditorGUILayout.HelpBox("Programs can be picked here once their jar was loaded by a first Play.", MessageType.None);
                return;
            }
            var program = serializedObject.FindProperty("settings").FindPropertyRelative("program");
            EditorGUILayout.LabelField("Programs");
            foreach (var name in names.Split('\n'))
            {
                if (!GUILayout.Toggle(program.stringValue == name, name, EditorStyles.radioButton) || program.stringValue == name) continue;
                program.stringValue = name;
                serializedObject.ApplyModifiedProperties();
            }
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

        /// <summary>One tick, and the simulation stands still afterwards.</summary>
        private static void Step(SimulationManager manager)
        {
            manager.Paused = true;
            manager.Step();
        }

        private static void Remember(SimulationManager manager)
        {
            var names = new List<string>();
            foreach (var program in manager.Programs) names.Add(program.Name);
            names.Sort(StringComparer.Ordinal);
            SessionState.SetString(KnownPrograms, string.Join("\n", names));
        }
    }
}
