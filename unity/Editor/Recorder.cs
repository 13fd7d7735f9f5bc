using System;
using System.Globalization;
using System.IO;
using Collektive.Bridge;
using org.collektive.frame;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The part of the manager's inspector about the JVM: memory, and a flight recording to start and stop while the scene plays.</summary>
    internal sealed class Recorder
    {
        /// <summary>Where recordings go: beside the project's assets, so that they are found and never imported.</summary>
        internal const string Folder = "Recordings";

        private const double Interval = 0.5;

        private JvmStatus status;
        private double asked = double.NegativeInfinity;

        internal void Draw()
        {
            if (Jvm.State != JvmState.Running) return;
            // Not with each repaint: it is a question to the JVM.
            if (EditorApplication.timeSinceStartup - asked >= Interval) Ask();
            EditorGUILayout.LabelField("Heap", Mebibytes(status.HeapUsed) + " of " + Mebibytes(status.HeapMaximum) + ", " + status.Collections + " collections");
            EditorGUILayout.LabelField("Flight recording", status.Recording.ToString().ToLowerInvariant() + (status.RecordingPath.Length > 0 ? ": " + status.RecordingPath : ""));
            if (status.RecordingError.Length > 0) EditorGUILayout.HelpBox(status.RecordingError, MessageType.Error);
            if (status.Recording == RecordingState.Off && GUILayout.Button("Start Recording")) Do(Start);
            if (status.Recording == RecordingState.On && GUILayout.Button("Stop Recording")) Do(JvmRecording.Stop);
        }

        private static void Start()
        {
            Directory.CreateDirectory(Folder);
            JvmRecording.Start(Path.Combine(Folder, "collektive-" + DateTime.Now.ToString("yyyyMMdd-HHmmss", CultureInfo.InvariantCulture) + ".jfr"), JvmRecording.Profile);
        }

        private void Do(Action action)
        {
            action();
            Ask();
        }

        private void Ask()
        {
            asked = EditorApplication.timeSinceStartup;
            status = Jvm.GetStatus();
        }

        private static string Mebibytes(long bytes) => (bytes >> 20).ToString(CultureInfo.InvariantCulture) + " MB";
    }
}
