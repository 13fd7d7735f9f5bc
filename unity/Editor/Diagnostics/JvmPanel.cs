using System;
using System.Threading.Tasks;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Draws the running JVM with its placement, start time and memory, and a button that restarts it.</summary>
    internal sealed class JvmPanel
    {
        private const double Interval = 0.5;
        private const int StopLimitMs = 5000;

        private double lastQuery = double.NegativeInfinity;

        // The query runs on another thread, because the JVM answers only between two ticks, and a tick may take long.
        private Task<JvmStatus> query;
        private string failure = "";

        /// <summary>The last status of the JVM; null if no JVM is running.</summary>
        internal JvmStatus Status { get; private set; }

        internal void Draw()
        {
            // A repaint must draw the same controls as the preceding layout.
            if (Event.current.type == EventType.Layout) Update();
            if (failure.Length > 0) EditorGUILayout.HelpBox(failure, MessageType.Error);
            if (Status == null)
            {
                EditorGUILayout.LabelField("JVM", Jvm.State == JvmState.None ? "not started" : Jvm.State.ToString().ToLowerInvariant());
                return;
            }
            EditorGUILayout.LabelField("JVM", Status.Version + ", " + Status.Home);
            EditorGUILayout.LabelField("Placement", Status.Process == 0 ? "in the editor's process" : "process " + Status.Process);
            EditorGUILayout.LabelField("Running since", (DateTime.Now - Status.Uptime).ToString("yyyy-MM-dd HH:mm:ss"));
            EditorGUILayout.LabelField(
                "Heap", Mebibytes(Status.HeapUsed) + " of " + Mebibytes(Status.HeapMaximum) + ", " + Status.Collections + " collections");
            EditorGUILayout.LabelField("Classes", Status.Classes + ", " + Mebibytes(Status.MetaspaceUsed));
            var isOwnProcess = Status.Process != 0;
            using (new EditorGUI.DisabledScope(!isOwnProcess || EditorApplication.isPlaying))
            {
                if (GUILayout.Button("Restart JVM")) Enqueue(() => Jvm.Stop(StopLimitMs));
            }
            if (!isOwnProcess) EditorGUILayout.LabelField(" ", "A JVM in the editor's process restarts with the editor.");
            else if (EditorApplication.isPlaying) EditorGUILayout.LabelField(" ", "Leave play mode to restart the JVM.");
        }

        /// <summary>Runs an action on the JVM after the query in progress, and then queries the status.</summary>
        internal void Enqueue(Action action)
        {
            lastQuery = EditorApplication.timeSinceStartup;
            var before = query ?? Task.FromResult(Status);
            query = before.ContinueWith(_ =>
            {
                action();
                return Jvm.TryGetStatus();
            }, TaskScheduler.Default);
        }

        /// <summary>Reads the answer of the last query, and begins the next query when it is due.</summary>
        private void Update()
        {
            if (query != null && query.IsCompleted)
            {
                failure = query.IsFaulted ? query.Exception.GetBaseException().Message : "";
                Status = query.IsFaulted ? Status : query.Result;
                query = null;
            }
            if (query != null || EditorApplication.timeSinceStartup - lastQuery < Interval) return;
            lastQuery = EditorApplication.timeSinceStartup;
            query = Task.Run(Jvm.TryGetStatus);
        }

        private static string Mebibytes(long bytes) => FormattableString.Invariant($"{bytes >> 20} MB");
    }
}
