using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Tools &gt; Collektive &gt; Diagnostics: nodes with their values and neighbours, errors, durations, the JVM's log, memory and
    /// recordings.</summary>
    internal sealed class DiagnosticsWindow : EditorWindow
    {
        private const int MaxRows = 200;

        private static readonly string[] Tabs = { "Nodes", "Errors", "Times", "Log", "JVM" };

        private readonly Recorder recorder = new Recorder();

        private Diagnostics diagnostics;
        private Vector2 scroll;
        private string filter = "";
        private int tab;
        private int selected = -1;

        internal static DiagnosticsWindow Open() => GetWindow<DiagnosticsWindow>("Collektive");

        private void OnDisable() => Detach();

        /// <summary>Ten times a second, by the editor.</summary>
        private void OnInspectorUpdate() => Repaint();

        private void OnGUI()
        {
            Attach();
            if (diagnostics == null)
            {
                EditorGUILayout.HelpBox("Press Play in a scene with a Simulation Manager.", MessageType.Info);
                return;
            }
            EditorGUILayout.LabelField("Simulation", Dashboard.State(diagnostics.Manager) + ", tick " + diagnostics.Manager.Tick);
            tab = GUILayout.Toolbar(tab, Tabs);
            scroll = GUILayout.BeginScrollView(scroll);
            if (tab == 0) DrawNodes();
            else if (tab == 1) DrawErrors();
            else if (tab == 2) DrawTimes();
            else if (tab == 3) DrawLog();
            else recorder.Draw();
            GUILayout.EndScrollView();
        }

        private void Attach()
        {
            var manager = SimulationManager.Current;
            if (diagnostics != null && manager != null && diagnostics.Manager == manager) return;
            Detach();
            if (EditorApplication.isPlaying && manager != null) diagnostics = new Diagnostics(manager);
        }

        private void Detach()
        {
            diagnostics?.Dispose();
            diagnostics = null;
            selected = -1;
        }

        private void DrawNodes()
        {
            filter = EditorGUILayout.TextField("Filter", filter);
            var rows = diagnostics.Nodes(filter);
            for (var i = 0; i < rows.Count && i < MaxRows; i++) DrawNode(rows[i]);
            if (rows.Count > MaxRows) EditorGUILayout.HelpBox((rows.Count - MaxRows) + " more; narrow the filter.", MessageType.None);
        }

        private void DrawNode(NodeRow row)
        {
            var id = row.Node.Id;
            var title = id + "  " + row.Node.name + "  (" + row.Program + ")  hears " + row.Hears + ", heard by " + row.Heard
                + (row.Node.LastError.Length > 0 ? "  ERROR" : "");
            var open = EditorGUILayout.Foldout(selected == id, title, true);
            if (open && selected != id)
            {
                selected = id;
                EditorGUIUtility.PingObject(row.Node);
            }
            if (!open && selected == id) selected = -1;
            if (selected == id) DrawDetails(row.Node);
        }

        private void DrawDetails(Node node)
        {
            EditorGUI.indentLevel++;
            if (node.LastError.Length > 0) EditorGUILayout.HelpBox(node.LastError, MessageType.Error);
            DrawLines(Diagnostics.TitleOf(node), diagnostics.Values(node.Id));
            EditorGUILayout.LabelField("Neighbours", EditorStyles.boldLabel);
            foreach (var row in diagnostics.Neighbours(node.Id))
            {
                EditorGUILayout.LabelField((row.IsHeard ? "hears " : "heard by ") + row.Id,
                    row.Link.Length.ToString("0.00") + " m, attenuation " + row.Link.Attenuation.ToString("0.##"));
            }
            EditorGUI.indentLevel--;
        }

        private void DrawErrors()
        {
            var errors = diagnostics.Errors();
            if (errors.Count == 0) EditorGUILayout.LabelField("No errors.");
            for (var i = 0; i < errors.Count && i < MaxRows; i++)
            {
                var error = errors[i];
                EditorGUILayout.LabelField(error.Source + ", node " + error.Node, error.Count + " times, last at tick " + error.LastTick);
                EditorGUILayout.HelpBox(error.LastMessage, MessageType.Error);
            }
        }

        private void DrawTimes()
        {
            EditorGUILayout.LabelField("Last " + diagnostics.Times.Count + " ticks", "mean, largest");
            DrawTime("Sense", diagnostics.Times.Of(times => times.Sense));
            DrawTime("Step", diagnostics.Times.Of(times => times.Step));
            DrawTime("  rounds", diagnostics.Times.Rounds);
            DrawTime("Act", diagnostics.Times.Of(times => times.Act));
            DrawTime("Physics", diagnostics.Times.Of(times => times.Physics));
            DrawTime("Whole tick", diagnostics.Times.Of(times => times.Total));
        }

        private void DrawLog()
        {
            foreach (var line in diagnostics.Log) EditorGUILayout.LabelField(line);
        }

        private static void DrawTime(string phase, (double Mean, double Max) time) =>
            EditorGUILayout.LabelField(phase, Dashboard.Milliseconds(time.Mean) + ", " + Dashboard.Milliseconds(time.Max));

        private static void DrawLines(string title, List<KeyValuePair<string, string>> lines)
        {
            EditorGUILayout.LabelField(title, EditorStyles.boldLabel);
            foreach (var line in lines) EditorGUILayout.LabelField(line.Key, line.Value);
        }
    }
}
