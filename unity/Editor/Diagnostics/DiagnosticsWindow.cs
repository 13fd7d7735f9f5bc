using System;
using System.Collections.Generic;
using UnityEditor;
using UnityEngine;
using UnityEngine.UIElements;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// The window Tools &gt; Collektive &gt; Diagnostics. It shows nodes with their values and neighbours, errors, durations, and the JVM's log, memory and
    /// recordings.
    /// </summary>
    internal sealed class DiagnosticsWindow : EditorWindow
    {
        private const int MaxErrors = 200;
        private const int NodesTab = 0;
        private const int JvmTab = 4;

        private static readonly string[] Tabs = { "Nodes", "Errors", "Times", "Log", "JVM" };

        private static readonly NodeColumn[] Columns =
        {
            new NodeColumn("Id", 60, row => row.Id.ToString(), (a, b) => a.Id.CompareTo(b.Id)),
            new NodeColumn("Name", 160, row => row.Name, (a, b) => string.CompareOrdinal(a.Name, b.Name)),
            new NodeColumn("Program", 120, row => row.Program, (a, b) => string.CompareOrdinal(a.Program, b.Program)),
            new NodeColumn("Receives from", 90, row => row.SenderCount.ToString(), (a, b) => a.SenderCount.CompareTo(b.SenderCount)),
            new NodeColumn("Sends to", 70, row => row.ReceiverCount.ToString(), (a, b) => a.ReceiverCount.CompareTo(b.ReceiverCount)),
            new NodeColumn("Error", 200, row => row.Error, (a, b) => string.CompareOrdinal(a.Error, b.Error)),
        };

        private readonly Recorder recorder = new Recorder();

        private MultiColumnListView list;
        private IMGUIContainer body;
        private Diagnostics diagnostics;
        private List<NodeRow> rows = new List<NodeRow>();
        private Vector2 scroll;
        private string filter = "";
        private int tab;
        private int selected = -1;

        internal static DiagnosticsWindow Open() => GetWindow<DiagnosticsWindow>("Collektive");

        private void CreateGUI()
        {
            rootVisualElement.Add(new IMGUIContainer(DrawHeader));
            list = new MultiColumnListView
            {
                sortingMode = ColumnSortingMode.Custom, showAlternatingRowBackgrounds = AlternatingRowBackground.ContentOnly, itemsSource = rows,
            };
            foreach (var column in Columns)
            {
                list.columns.Add(new Column
                {
                    name = column.Name, title = column.Name, width = column.Width, stretchable = true, makeCell = () => new Label(),
                    bindCell = (cell, index) => ((Label)cell).text = column.Text(rows[index]),
                });
            }
            list.columnSortingChanged += Refresh;
            list.selectionChanged += Select;
            list.style.flexGrow = 1;
            rootVisualElement.Add(list);
            body = new IMGUIContainer(DrawBody);
            body.style.flexGrow = 1;
            rootVisualElement.Add(body);
            Refresh();
        }

        private void OnDisable() => Detach();

        /// <summary>Called by the editor ten times a second.</summary>
        private void OnInspectorUpdate()
        {
            Refresh();
            Repaint();
        }

        private void Attach()
        {
            var manager = SimulationManager.Current;
            // A manager that has failed is not the current one, but its errors and its log are still of interest.
            var isKept = diagnostics != null && diagnostics.Manager != null && (manager == null || manager == diagnostics.Manager);
            if (isKept && EditorApplication.isPlaying) return;
            Detach();
            if (EditorApplication.isPlaying && manager != null) diagnostics = new Diagnostics(manager);
        }

        private void Detach()
        {
            diagnostics?.Dispose();
            diagnostics = null;
            selected = -1;
        }

        /// <summary>Reads the nodes, and shows the parts of the window that belong to the tab.</summary>
        private void Refresh()
        {
            Attach();
            if (list == null) return;
            var isShown = tab == NodesTab && diagnostics != null;
            list.style.display = isShown ? DisplayStyle.Flex : DisplayStyle.None;
            body.style.display = isShown && selected < 0 ? DisplayStyle.None : DisplayStyle.Flex;
            if (!isShown) return;
            list.itemsSource = rows = diagnostics.Nodes(filter);
            rows.Sort(Compare);
            list.RefreshItems();
            var index = rows.FindIndex(row => row.Id == selected);
            list.SetSelectionWithoutNotify(index < 0 ? new int[0] : new[] { index });
        }

        private int Compare(NodeRow a, NodeRow b)
        {
            foreach (var sorted in list.sortedColumns)
            {
                var order = Array.Find(Columns, column => column.Name == sorted.columnName).Compare(a, b);
                if (order != 0) return sorted.direction == SortDirection.Ascending ? order : -order;
            }
            return a.Id.CompareTo(b.Id);
        }

        private void Select(IEnumerable<object> items)
        {
            selected = -1;
            foreach (var item in items)
            {
                if (!(item is NodeRow row)) continue;
                selected = row.Id;
                if (row.Node != null) EditorGUIUtility.PingObject(row.Node);
            }
            Refresh();
        }

        private void DrawHeader()
        {
            // A repaint must draw the same controls as the preceding layout.
            if (Event.current.type == EventType.Layout) Attach();
            EditorGUI.BeginChangeCheck();
            tab = GUILayout.Toolbar(tab, Tabs);
            if (diagnostics != null)
            {
                EditorGUILayout.LabelField("Simulation", Dashboard.State(diagnostics.Manager) + ", tick " + diagnostics.Manager.Tick);
                if (tab == NodesTab) filter = EditorGUILayout.TextField("Filter", filter);
            }
            else if (tab != JvmTab) EditorGUILayout.HelpBox("Press Play in a scene with a Simulation Manager.", MessageType.Info);
            if (EditorGUI.EndChangeCheck()) Refresh();
        }

        private void DrawBody()
        {
            scroll = GUILayout.BeginScrollView(scroll);
            if (tab == JvmTab) recorder.Draw();
            else if (diagnostics != null) DrawTab();
            GUILayout.EndScrollView();
        }

        private void DrawTab()
        {
            var node = diagnostics.Manager.Find(selected);
            if (tab == 1) DrawErrors();
            else if (tab == 2) DrawTimes();
            else if (tab == 3) DrawLog();
            else if (node != null) DrawDetails(node);
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
                var suffix = error.Node == NodeErrors.NoNode ? "" : error.Node == NodeErrors.DepartedNodes ? ", nodes that have left" : ", node " + error.Node;
                EditorGUILayout.LabelField(error.Source + suffix, error.Count + " times, last at tick " + error.LastTick);
                EditorGUILayout.HelpBox(error.LastMessage, MessageType.Error);
            }
        }

        private void DrawTimes()
        {
            EditorGUILayout.LabelField("Last " + diagnostics.Times.Count + " ticks", "mean, largest");
            DrawTime("Queries", diagnostics.Times.Of(times => times.Queries));
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
