using System;
using System.Globalization;
using System.IO;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Draws the JVM and the controls of flight recordings in an inspector or a window.</summary>
    internal sealed class Recorder
    {
        /// <summary>Folder of recordings. It is outside of the assets, so that Unity does not import recordings.</summary>
        internal const string Folder = "Recordings";

        private static readonly GUIContent Settings = new GUIContent(
            "Recording settings", "default: low overhead, for continuous recording. profile: more samples. Or the path of a .jfc file.");

        private readonly JvmPanel jvm = new JvmPanel();
        private string settings = JvmRecording.Profile;

        internal void Draw()
        {
            jvm.Draw();
            var status = jvm.Status;
            if (status == null) return;
            EditorGUILayout.LabelField("Flight recording", status.Recording.ToString().ToLowerInvariant()
                + (status.RecordingPath.Length > 0 ? ": " + status.RecordingPath : ""));
            if (status.RecordingError.Length > 0) EditorGUILayout.HelpBox(status.RecordingError, MessageType.Error);
            if (status.Recording == RecordingState.Off)
            {
                settings = EditorGUILayout.TextField(Settings, settings);
                if (GUILayout.Button("Start Recording")) Start(NewFile("collektive"), settings);
            }
            if (status.Recording == RecordingState.On)
            {
                if (GUILayout.Button("Dump Recording")) Dump(NewFile("dump"));
                if (GUILayout.Button("Stop Recording")) jvm.Enqueue(JvmRecording.Stop);
            }
            if (status.RecordingsWritten > 0 && GUILayout.Button("Show Recordings")) EditorUtility.RevealInFinder(Folder);
        }

        private static string NewFile(string name) =>
            Path.Combine(Folder, name + "-" + DateTime.Now.ToString("yyyyMMdd-HHmmss", CultureInfo.InvariantCulture) + ".jfr");

        private void Start(string file, string chosen) => jvm.Enqueue(() => JvmRecording.Start(file, chosen));

        private void Dump(string file) => jvm.Enqueue(() => JvmRecording.Dump(file));
    }
}
