using System;
using System.Globalization;
using System.IO;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Draws the JVM's memory and the controls of flight recordings in an inspector or a window.</summary>
    internal sealed class Recorder
    {
        /// <summary>Folder of recordings, outside the assets so that Unity does not import them.</summary>
        internal const string Folder = "Recordings";

        private const double Interval = 0.5;

        private static readonly GUIContent Settings = new GUIContent(
            "Recording settings", "default: low overhead, for continuous recording. profile: more samples. Or the path of a .jfc file.");

        private string settings = JvmRecording.Profile;
        private JvmStatus status;
        private double lastQuery = double.NegativeInfinity;

        internal void Draw()
        {
            // A repaint must draw the controls of the layout before it; and the call into the JVM takes time.
            if (Event.current.type == EventType.Layout && EditorApplication.timeSinceStartup - lastQuery >= Interval) Refresh();
            if (status == null) return;
            EditorGUILayout.LabelField("Heap", Mebibytes(status.HeapUsed) + " of " + Mebibytes(status.HeapMaximum) + ", " + status.Collections
                + " collections");
            EditorGUILayout.LabelField("Flight recording", status.Recording.ToString().ToLowerInvariant()
                + (status.RecordingPath.Length > 0 ? ": " + status.RecordingPath : ""));
            if (status.RecordingError.Length > 0) EditorGUILayout.HelpBox(status.RecordingError, MessageType.Error);
            if (status.Recording == RecordingState.Off)
            {
                settings = EditorGUILayout.TextField(Settings, settings);
                if (GUILayout.Button("Start Recording")) Do(() => JvmRecording.Start(NewFile("collektive"), settings));
            }
            if (status.Recording == RecordingState.On)
            {
                if (GUILayout.Button("Dump Recording")) Do(() => JvmRecording.Dump(NewFile("dump")));
                if (GUILayout.Button("Stop Recording")) Do(JvmRecording.Stop);
            }
            if (status.RecordingsWritten > 0 && GUILayout.Button("Show Recordings")) EditorUtility.RevealInFinder(Folder);
        }

        private static string NewFile(string name) =>
            Path.Combine(Folder, name + "-" + DateTime.Now.ToString("yyyyMMdd-HHmmss", CultureInfo.InvariantCulture) + ".jfr");

        private void Do(Action action)
        {
            action();
            Refresh();
        }

        private void Refresh()
        {
            lastQuery = EditorApplication.timeSinceStartup;
            status = Jvm.TryGetStatus();
        }

        private static string Mebibytes(long bytes) => (bytes >> 20).ToString(CultureInfo.InvariantCulture) + " MB";
    }
}
