using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Tools &gt; Collektive &gt; Diagnostics: nodes with their values and neighbours, errors, durations, the JVM's log, memory and
    /// recordings.</summary>
    internal sealed class DiagnosticsWindow : EditorWindow
    {
        private const int MaxErrors = 200;

        private static readonly string[] Tabs = { "Nodes", "Errors", "Times", "Log", "JVM" };

        private readonly Recorder recorder = new Recorder();

        private Diagnostics diagnostics;
        private List<NodeRow> rows;
        private Vector2 listScroll;
        private Vector2 scroll;
        private string filter = "";
        private string filtered;
        private bool isStale;
        private int tab;
        private int selected = -1;

        internal static DiagnosticsWindow Open() => GetWindow<DiagnosticsWindow>("Collektive");

        private void OnDisable() => Detach();

        /// <summary>Ten times a second, by the editor.</summary>
        private void OnInspectorUpdate()
        {
            isStale = true;
            Repaint();
        }

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
            if (tab == 0) DrawNodes();
            else DrawTab();
        }

        private void DrawTab()
        {
            scroll = GUILayout.BeginScrollView(scroll);
            if (tab == 1) DrawErrors();
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
            rows = null;
            isStale = true;
            selected = -1;
        }

        /// <summary>Draws the visible part of the list of nodes, and the details of the selected node.</summary>
        private void DrawNodes()
        {
            filter = EditorGUILayout.TextField("Filter", filter);
            // A repaint must draw the controls of the layout before it.
            if (Event.current.type == EventType.Layout && (isStale || filter != filtered)) TakeRows();
            var height = EditorGUIUtility.singleLineHeight + EditorGUIUtility.standardVerticalSpacing;
            var viewHeight = selected < 0 ? position.height : position.height / 2;
            var first = Mathf.Clamp((int)(listScroll.y / height), 0, rows.Count);
            var last = Mathf.Min(first + (int)(viewHeight / height) + 2, rows.Count);
            listScroll = selected < 0 ? GUILayout.BeginScrollView(listScroll) : GUILayout.BeginScrollView(listScroll, GUILayout.Height(viewHeight));
            GUILayout.Space(first * height);
            for (var i = first; i < last; i++) DrawNode(rows[i]);
            GUILayout.Space((rows.Count - last) * height);
            GUILayout.EndScrollView();
            if (selected < 0) return;
            scroll = GUILayout.BeginScrollView(scroll);
            var node = diagnostics.Manager.Find(selected);
            if (node != null) DrawDetails(node);
            GUILayout.EndScrollView();
        }

        private void TakeRows()
        {
            isStale = false;
            filtered = filter;
            rows = diagnostics.Nodes(filter);
        }

        private void DrawNode(NodeRow row)
        {
            var name = row.Node == null ? "(destroyed)" : row.Node.name;
            var title = row.Id + "  " + name + "  (" + row.Program + ")  receives from " + row.SenderCount + ", sends to " + row.ReceiverCount
                + (row.Node != null && row.Node.LastError.Length > 0 ? "  ERROR" : "");
            var open = EditorGUILayout.Foldout(selected == row.Id, title, true);
            if (open && selected != row.Id)
            {
                selected = row.Id;
                if (row.Node != null) EditorGUIUtility.PingObject(row.Node);
            }
            if (!open && selected == row.Id) selected = -1;
        }

        private void DrawDetails(Node node)
        {
            EditorGUILayout.LabelField(node.Id + "  " + node.name, EditorStyles.boldLabel);
            EditorGUI.indentLevel++;
            if (node.LastError.Length > 0) EditorGUILayout.HelpBox(node.LastError, MessageType.Error);
            DrawLines(Diagnostics.TitleOf(node), diagnostics.Values(node.Id));
            EditorGUILayout.LabelField("Neighbours", EditorStyles.boldLabel);
            foreach (var row in diagnostics.Neighbours(node.Id))
            {
                EditorGUILayout.LabelField((row.IsSender ? "from " : "to ") + row.Id,
                    row.Link.Length.ToString("0.00") + " m, attenuation " + row.Link.Attenuation.ToString("0.##"));
            }
            EditorGUI.indentLevel--;
        }

        private void DrawErrors()
        {
            var errors = diagnostics.Errors();
            if (errors.Count == 0) EditorGUILayout.LabelField("No errors.");
            for (var i = 0; i < errors.Count && i < MaxErrors; i++)
            {
                var error = errors[i];
                var place = error.Node == NodeErrors.NoNode ? "" : error.Node == NodeErrors.DepartedNodes ? ", nodes that have left" : ", node " + error.Node;
                EditorGUILayout.LabelField(error.Source + place, error.Count + " times, last at tick " + error.LastTick);
                EditorGUILayout.HelpBox(error.LastMessage, MessageType.Error);
            }
        }

        private void DrawTimes()
        {
            EditorGUILayout.LabelField("Last " + diagnostics.Times.Count + " ticks", "mean, largest");
            DrawTime("Rules", diagnostics.Times.Of(times => times.Rules));
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
