using System;
using System.Globalization;
using System.IO;
using System.Threading.Tasks;
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
        private string failure = "";
        private double lastQuery = double.NegativeInfinity;

        // On another thread, because the JVM answers between two ticks only, which may take as long as the limit of a tick.
        private Task<JvmStatus> query;

        internal void Draw()
        {
            // A repaint must draw the controls of the layout before it.
            if (Event.current.type == EventType.Layout) Update();
            if (failure.Length > 0) EditorGUILayout.HelpBox(failure, MessageType.Error);
            if (status == null) return;
            EditorGUILayout.LabelField("Heap", Mebibytes(status.HeapUsed) + " of " + Mebibytes(status.HeapMaximum) + ", " + status.Collections
                + " collections");
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
                if (GUILayout.Button("Stop Recording")) Ask(JvmRecording.Stop);
            }
            if (status.RecordingsWritten > 0 && GUILayout.Button("Show Recordings")) EditorUtility.RevealInFinder(Folder);
        }

        private static string NewFile(string name) =>
            Path.Combine(Folder, name + "-" + DateTime.Now.ToString("yyyyMMdd-HHmmss", CultureInfo.InvariantCulture) + ".jfr");

        private void Start(string file, string chosen) => Ask(() => JvmRecording.Start(file, chosen));

        private void Dump(string file) => Ask(() => JvmRecording.Dump(file));

        /// <summary>Does something with the recording after the query in progress, and then queries the status.</summary>
        private void Ask(Action action)
        {
            lastQuery = EditorApplication.timeSinceStartup;
            var before = query ?? Task.FromResult(status);
            query = before.ContinueWith(_ =>
            {
                action();
                return Jvm.TryGetStatus();
            }, TaskScheduler.Default);
        }

        /// <summary>Takes the answer of the last query, and begins the next one when it is due.</summary>
        private void Update()
        {
            if (query != null && query.IsCompleted)
            {
                failure = query.IsFaulted ? query.Exception.GetBaseException().Message : "";
                status = query.IsFaulted ? status : query.Result;
                query = null;
            }
            if (query != null || EditorApplication.timeSinceStartup - lastQuery < Interval) return;
            lastQuery = EditorApplication.timeSinceStartup;
            query = Task.Run(Jvm.TryGetStatus);
        }

        private static string Mebibytes(long bytes) => (bytes >> 20).ToString(CultureInfo.InvariantCulture) + " MB";
    }
}
