using System;
using System.Collections.Generic;
using System.Threading.Tasks;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The inspector of JVM settings. It shows the running JVM, and for each setting the unit, the value in effect and the error.</summary>
    [CustomEditor(typeof(JvmSettingsAsset))]
    internal sealed class JvmSettingsEditor : UnityEditor.Editor
    {
        private readonly JvmPanel jvm = new JvmPanel();
        private JvmReport report;
        private string failure = "";
        private string reported;
        private Task<JvmReport> check;

        /// <summary>Returns true while the JVM runs, because its answers arrive in the background and its memory use changes.</summary>
        public override bool RequiresConstantRepaint() => Jvm.State == JvmState.Running;

        /// <inheritdoc/>
        public override void OnInspectorGUI()
        {
            var settings = ((JvmSettingsAsset)target).settings;
            CheckIfChanged(settings);
            serializedObject.Update();
            if (failure.Length > 0) EditorGUILayout.HelpBox(failure, MessageType.Error);
            if (report != null && report.Notice.Length > 0) EditorGUILayout.HelpBox(report.Notice, MessageType.Info);
            jvm.Draw();
            var fields = serializedObject.FindProperty("settings");
            foreach (var setting in JvmSetting.All)
            {
                if (setting.Key == nameof(JvmSettings.home) && settings.location != JvmLocation.Folder) continue;
                Draw(setting, fields.FindPropertyRelative(setting.Key));
            }
            serializedObject.ApplyModifiedProperties();
        }

        private void Draw(JvmSetting setting, SerializedProperty field)
        {
            var label = new GUIContent(setting.Unit.Length > 0 ? setting.Label + " (" + setting.Unit + ")" : setting.Label, setting.Tooltip);
            if (setting.Type == typeof(int)) EditorGUILayout.DelayedIntField(field, label);
            else if (setting.Type == typeof(string)) EditorGUILayout.DelayedTextField(field, label);
            else EditorGUILayout.PropertyField(field, label, true);
            if (report == null) return;
            var effective = report.Effective(setting);
            if (effective.Length > 0) EditorGUILayout.LabelField(" ", "in effect: " + effective);
            var problem = report.Problem(setting);
            if (problem.Length > 0) EditorGUILayout.HelpBox(problem, MessageType.Error);
        }

        /// <summary>Checks the settings again if they or the JVM's state changed.</summary>
        private void CheckIfChanged(JvmSettings settings)
        {
            var now = Jvm.State + " " + Jvm.Process + TextOf(settings);
            if (now == reported || check != null) return;
            reported = now;
            // The package's files must be located on the main thread, but not during a GUI event.
            EditorApplication.delayCall += () => Start(settings.Copy());
        }

        private void Start(JvmSettings settings)
        {
            if (this == null) return;
            try
            {
                var status = Jvm.TryGetStatus();
                var launch = TryFind(settings, out var problem);
                check = Task.Run(() => JvmReport.Of(settings, status, _ => launch ?? throw problem));
            }
            catch (Exception error)
            {
                check = Task.FromException<JvmReport>(error);
            }
            EditorApplication.update += Finish;
        }

        private static JvmLaunch TryFind(JvmSettings settings, out BridgeException problem)
        {
            problem = null;
            try
            {
                return Installation.ToLaunch(settings);
            }
            catch (BridgeException error)
            {
                problem = error;
                return null;
            }
        }

        private void Finish()
        {
            if (!check.IsCompleted) return;
            EditorApplication.update -= Finish;
            failure = check.IsFaulted ? "The JVM settings could not be checked: " + check.Exception.GetBaseException().Message : "";
            report = check.IsFaulted ? null : check.Result;
            check = null;
            if (this != null) Repaint();
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
