using System.Collections.Generic;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The inspector of JVM settings. Shows the unit, the value in effect and the error of each.</summary>
    [CustomEditor(typeof(JvmSettingsAsset))]
    internal sealed class JvmSettingsEditor : UnityEditor.Editor
    {
        private const int StopLimitMs = 5000;

        private JvmReport report;
        private string reported;

        /// <inheritdoc/>
        public override void OnInspectorGUI()
        {
            var settings = ((JvmSettingsAsset)target).settings;
            Check(settings);
            serializedObject.Update();
            if (report.Notice.Length > 0) EditorGUILayout.HelpBox(report.Notice, MessageType.Info);
            DrawProcess();
            var fields = serializedObject.FindProperty("settings");
            foreach (var setting in JvmSetting.All)
            {
                if (setting.Key == nameof(JvmSettings.home) && settings.location != JvmLocation.Folder) continue;
                Draw(setting, fields.FindPropertyRelative(setting.Key));
            }
            serializedObject.ApplyModifiedProperties();
        }

        /// <summary>Draws the state of a JVM in a separate process, which can be restarted between plays.</summary>
        private void DrawProcess()
        {
            if (Jvm.Process == 0 || Jvm.State != JvmState.Running) return;
            if (report.Status != null) EditorGUILayout.LabelField("JVM", Dashboard.OfProcess(report.Status));
            using (new EditorGUI.DisabledScope(Application.isPlaying))
            {
                if (GUILayout.Button("Restart JVM")) Stop();
            }
        }

        /// <summary>The next Play starts a new JVM.</summary>
        private void Stop()
        {
            try
            {
                Jvm.Stop(StopLimitMs);
            }
            catch (BridgeException error)
            {
                Debug.LogWarning(error.Message, target);
            }
        }

        private void Draw(JvmSetting setting, SerializedProperty field)
        {
            var label = setting.Unit.Length > 0 ? setting.Label + " (" + setting.Unit + ")" : setting.Label;
            EditorGUILayout.PropertyField(field, new GUIContent(label, setting.Tooltip), true);
            var effective = report.Effective(setting);
            if (effective.Length > 0) EditorGUILayout.LabelField(" ", "in effect: " + effective);
            var problem = report.Problem(setting);
            if (problem.Length > 0) EditorGUILayout.HelpBox(problem, MessageType.Error);
        }

        /// <summary>Checks the settings again if they or the JVM's state changed.</summary>
        private void Check(JvmSettings settings)
        {
            var now = Jvm.State + " " + Jvm.Process + TextOf(settings);
            if (now == reported) return;
            reported = now;
            report = JvmReport.Of(settings, Installation.ToLaunch);
        }

        private static string TextOf(JvmSettings settings)
        {
            var text = "";
            foreach (var setting in JvmSetting.All)
            {
                var value = setting.Get(settings);
                text += "\n" + (value is IEnumerable<string> words ? string.Join("\n ", words) : value);
            }
            return text;
        }
    }
}
