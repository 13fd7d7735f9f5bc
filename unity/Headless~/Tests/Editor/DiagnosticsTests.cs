using System.Collections.Generic;
using System.IO;
using System.Linq;
using Collektive.Bridge;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;
using UnityEngine.UIElements;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>Tests the inspector of the Simulation Manager, and the diagnostics window, during a simulation.</summary>
    public sealed class DiagnosticsTests : SimulationFixture
    {
        [SetUp]
        public void EnterPlayMode()
        {
            Gui.Clear();
            EditorApplication.isPlaying = true;
        }

        [TearDown]
        public void LeavePlayMode()
        {
            EditorApplication.isPlaying = false;
            DiagnosticsWindow.Open().Close();
        }

        [Test]
        public void Nodes_are_listed_with_their_neighbours()
        {
            MakeThree();
            var diagnostics = new Diagnostics(Manager);
            var rows = diagnostics.Nodes("");
            Assert.That(rows.ConvertAll(row => (row.Node.Id, row.Program, row.SenderCount, row.ReceiverCount)),
                Is.EqualTo(new[] { (0, "double", 1, 2), (1, "double", 1, 1), (2, "double", 1, 0) }));
            Assert.That(diagnostics.Nodes("2").Count, Is.EqualTo(1));
            Assert.That(diagnostics.Nodes("DOUB").Count, Is.EqualTo(3));
            Assert.That(diagnostics.Nodes("nothing"), Is.Empty);
            Assert.That(diagnostics.Neighbours(0).ConvertAll(row => (row.Id, row.IsSender)), Is.EqualTo(new[] { (1, true), (1, false), (2, false) }));
        }

        [Test]
        public void Fields_of_a_nodes_answer_are_listed()
        {
            MakeThree();
            var values = new Diagnostics(Manager).Values(1);
            Assert.That(values, Has.Some.EqualTo(new KeyValuePair<string, string>("Value", "4")));
            Assert.That(new Diagnostics(Manager).Values(17), Is.Empty);
        }

        [Test]
        public void The_last_answer_and_its_tick_are_kept_until_the_next_answer()
        {
            var node = MakeThree()[1].Node;
            node.Sleep(10);
            Play(5);
            Assert.That(new Diagnostics(Manager).Values(1), Has.Some.EqualTo(new KeyValuePair<string, string>("Value", "4")));
            Assert.That(Diagnostics.TitleOf(node), Is.EqualTo("Answer of tick " + (Manager.Tick - 5)));
            node.enabled = false;
            node.enabled = true;
            Assert.That(Diagnostics.TitleOf(node), Is.EqualTo("No answer yet"));
        }

        [Test]
        public void Errors_are_counted_by_program_or_component_and_node()
        {
            var nodes = MakeThree();
            nodes[1].Node.gameObject.AddComponent<BrokenSensor>();
            Play(3);
            var errors = new Diagnostics(Manager).Errors();
            Assert.That(errors.Count, Is.EqualTo(1));
            Assert.That((errors[0].Source, errors[0].Node, errors[0].Count, errors[0].LastTick), Is.EqualTo(("BrokenSensor", 1, 3L, 4UL)));
            Assert.That(errors[0].LastMessage, Is.EqualTo("out of order"));
            Assert.That(Manager.ErrorCount, Is.EqualTo(3));
        }

        [Test]
        public void Errors_of_departed_nodes_are_summed()
        {
            var nodes = MakeThree();
            for (var i = 0; i < 3; i++) nodes[i].Node.gameObject.AddComponent<BrokenSensor>();
            Play(2);
            nodes[0].Node.enabled = false;
            Object.DestroyImmediate(nodes[2].Node.gameObject);
            Play(1);
            var errors = new Diagnostics(Manager).Errors();
            Assert.That(errors.ConvertAll(each => (each.Source, each.Node, each.Count)),
                Is.EqualTo(new[] { ("BrokenSensor", NodeErrors.DepartedNodes, 4L), ("BrokenSensor", 1, 3L) }));
            Assert.That(Manager.ErrorCount, Is.EqualTo(7));
            nodes[0].Node.enabled = true;
            Play(1);
            Assert.That(Manager.Errors.Count, Is.EqualTo(3), "a node that has rejoined must have a separate entry");
            Manager.enabled = false;
            Assert.That(Manager.Errors.Count, Is.EqualTo(3), "the errors must stay after the end of the simulation");
        }

        [Test]
        public void Durations_and_log_lines_are_collected_until_Dispose()
        {
            const string line = "info: [node 0, program trouble] a line from the program";
            const float printing = 20;
            Configure("trouble");
            MakeNode(printing);
            Play(1);
            var diagnostics = new Diagnostics(Manager);
            Play(3);
            Assert.That(diagnostics.Times.Count, Is.EqualTo(3));
            Assert.That(diagnostics.Times.Of(times => times.Step).Max, Is.GreaterThanOrEqualTo(Manager.Times.Step));
            Assert.That(diagnostics.Log, Has.Some.EqualTo(line));
            var kept = diagnostics.Log.Count;
            diagnostics.Dispose();
            Play(2);
            Assert.That(Log.FindAll(message => line.EndsWith(message)).Count, Is.GreaterThan(kept), "more lines must have arrived");
            Assert.That((diagnostics.Times.Count, diagnostics.Log.Count), Is.EqualTo((3, kept)));
        }

        [Test]
        public void Selecting_a_node_in_the_window_shows_its_values()
        {
            MakeThree();
            Draw();
            Assert.That(Rows()[1], Is.EqualTo("row 1 | Probe | double | 1 | 1 | "));
            Assert.That(Gui.Lines, Has.None.EqualTo("label Value: 4"));
            Table.ClickRow(1);
            Draw();
            Assert.That(Gui.Lines, Has.Some.EqualTo("label Value: 4"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("label from 0: 1.00 m, attenuation 0"));
            Assert.That(Project.Pinged, Is.EqualTo(Manager.Nodes[1]));
        }

        [Test]
        public void Rows_are_sorted_by_the_clicked_column_and_the_selected_node_stays_selected()
        {
            MakeThree();
            Draw();
            Table.ClickRow(0);
            Table.ClickHeader("Sends to", SortDirection.Ascending);
            Draw();
            Assert.That(Rows().ConvertAll(row => row.Substring(0, 5)), Is.EqualTo(new[] { "row 2", "row 1", "row 0" }));
            Assert.That(Table.selectedIndex, Is.EqualTo(2));
            Table.ClickHeader("Sends to", SortDirection.Descending);
            Draw();
            Assert.That(Rows()[0], Is.StringStarting("row 0 | Probe"));
            Assert.That(Table.selectedIndex, Is.EqualTo(0));
        }

        [Test]
        public void The_window_filters_nodes_and_binds_only_visible_rows()
        {
            for (var i = 0; i < 1000; i++) MakeNode(0, i * Vector3.right);
            Play(1);
            Draw();
            Assert.That(Rows().Count, Is.InRange(20, 40));
            Assert.That(Table.itemsSource.Count, Is.EqualTo(1000));
            Gui.Act("Filter", "999");
            Draw();
            Draw();
            Assert.That(Rows(), Is.EqualTo(new[] { "row 999 | Probe | double | 0 | 0 | " }));
        }

        [Test]
        public void A_destroyed_node_is_marked_until_the_window_updates()
        {
            var nodes = MakeThree();
            Draw();
            Object.DestroyImmediate(nodes[2].Node.gameObject);
            Draw();
            Assert.That(Rows()[2], Is.StringStarting("row 2 | (destroyed) | "));
            Menus.Send(DiagnosticsWindow.Open(), "OnInspectorUpdate");
            Draw();
            Assert.That(Rows().Count, Is.EqualTo(2));
        }

        [Test]
        public void The_window_shows_the_JVM_without_a_simulation_and_restarts_one_in_its_own_process()
        {
            MakeThree();
            EditorApplication.isPlaying = false;
            Object.DestroyImmediate(Manager.gameObject);
            Draw();
            Gui.Act("toolbar", 4);
            AwaitInWindow("label Running since: ");
            Assert.That(Gui.Lines, Has.Some.StringStarting("label Heap: ").And.Some.StringStarting("label JVM: ").And.Some.StringStarting("label Placement: "));
            Assert.That(Gui.Lines, Has.None.StringStarting("help"));
            if (TestJvm.Placement == JvmPlacement.InProcess)
            {
                Assert.That(Gui.Lines, Has.Some.EqualTo("(disabled) button Restart JVM"));
                Assert.That(Gui.Lines, Has.Some.EqualTo("label  : A JVM in the editor's process restarts with the editor."));
                return;
            }
            var before = Jvm.Process;
            Gui.Act("Restart JVM", true);
            AwaitInWindow("label JVM: stopped");
            TestJvm.Start();
            Assert.That(Jvm.Process, Is.Not.EqualTo(before));
        }

        [Test]
        public void A_recording_that_starts_between_layout_and_repaint_shows_at_the_next_layout()
        {
            MakeThree();
            var inspector = UnityEditor.Editor.CreateEditor(Manager);
            Gui.Passes(inspector.OnInspectorGUI);
            var file = Path.Combine(Path.GetTempPath(), "collektive-" + System.Guid.NewGuid().ToString("N") + ".jfr");
            try
            {
                // The recorder queries the state of the JVM only twice a second.
                System.Threading.Thread.Sleep(600);
                Gui.Passes(inspector.OnInspectorGUI, () =>
                {
                    JvmRecording.Start(file);
                    System.Threading.Thread.Sleep(600);
                });
                Assert.That(Gui.Lines, Has.None.EqualTo("button Stop Recording"));
                Inspect(inspector, "button Stop Recording");
            }
            finally
            {
                JvmRecording.Stop();
                Inspect(inspector, "button Start Recording");
                File.Delete(file);
            }
        }

        [Test]
        public void The_window_has_tabs_for_errors_times_and_log()
        {
            MakeThree();
            Draw();
            foreach (var (tab, line) in new[] { (1, "label No errors."), (2, "label Last 0 ticks: mean, largest"),
                (3, "toolbar Nodes Errors Times Log JVM: Log"), (4, "toolbar Nodes Errors Times Log JVM: JVM") })
            {
                Gui.Act("toolbar", tab);
                Draw();
                Draw();
                Assert.That(Gui.Lines, Has.Some.EqualTo(line));
            }
        }

        [Test]
        public void Without_a_manager_the_window_shows_a_hint()
        {
            Object.DestroyImmediate(Manager.gameObject);
            Draw();
            Assert.That(Gui.Lines, Is.EqualTo(new[]
            {
                "toolbar Nodes Errors Times Log JVM: Nodes", "help Info: Press Play in a scene with a Simulation Manager.",
            }));
        }

        [Test]
        public void The_window_keeps_the_errors_of_a_simulation_that_has_failed()
        {
            MakeThree();
            Draw();
            Manager.Fail("out of memory", null);
            Gui.Act("toolbar", 1);
            Draw();
            Draw();
            Assert.That(Gui.Lines, Has.Some.EqualTo("label No errors."));
        }

        [Test]
        public void The_window_survives_the_end_of_play_mode()
        {
            MakeThree();
            Draw();
            Object.DestroyImmediate(Manager.gameObject);
            Draw();
            Assert.That(Gui.Lines, Has.Some.Contains("Press Play"));
        }

        [Test]
        public void The_inspector_has_a_dashboard_and_buttons_while_playing()
        {
            MakeThree();
            var inspector = UnityEditor.Editor.CreateEditor(Manager);
            Gui.Passes(inspector.OnInspectorGUI);
            Assert.That(inspector.RequiresConstantRepaint(), Is.True);
            foreach (var line in new[] { "label State: running", "label Nodes: 3", "label Links: 3", "label Messages: 3 sent, 0 dropped, 0 delayed, 0 expired",
                "label Tick: 1 (0.05 s)", "label JVM: running", "label Errors: 0" })
            {
                Assert.That(Gui.Lines, Has.Some.EqualTo(line));
            }
            Gui.Act("Pause", true);
            Gui.Passes(inspector.OnInspectorGUI);
            Assert.That(Manager.Paused, Is.True);
            Gui.Act("Step", true);
            Gui.Passes(inspector.OnInspectorGUI);
            Assert.That(Manager.Tick, Is.EqualTo(2));
            Assert.That(Manager.Paused, Is.True);
        }

        [Test]
        public void The_dashboard_counts_dropped_and_delayed_messages()
        {
            Configure("double", settings => settings.network = new NetworkModel { loss = 1 });
            MakeThree();
            Gui.Passes(UnityEditor.Editor.CreateEditor(Manager).OnInspectorGUI);
            Assert.That(Gui.Lines, Has.Some.EqualTo("label Messages: 3 sent, 3 dropped, 0 delayed, 0 expired"));
            Configure("double", settings => settings.network = new NetworkModel { delay = 1 });
            MakeThree();
            Gui.Passes(UnityEditor.Editor.CreateEditor(Manager).OnInspectorGUI);
            Assert.That(Gui.Lines, Has.Some.EqualTo("label Messages: 3 sent, 0 dropped, 3 delayed, 0 expired"));
        }

        [Test]
        public void The_inspector_does_not_wait_for_a_busy_JVM()
        {
            MakeThree();
            var inspector = UnityEditor.Editor.CreateEditor(Manager);
            lock (JvmControl.Gate)
            {
                Gui.Passes(inspector.OnInspectorGUI);
                System.Threading.Thread.Sleep(600);
                Gui.Passes(inspector.OnInspectorGUI);
            }
            Inspect(inspector, "button Start Recording");
        }

        [Test]
        public void A_flight_recording_can_be_started_dumped_stopped_and_shown_from_the_inspector()
        {
            MakeThree();
            var before = Directory.GetCurrentDirectory();
            var folder = Path.Combine(Path.GetTempPath(), "collektive-recorder-" + System.Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
            Directory.SetCurrentDirectory(folder);
            try
            {
                var inspector = UnityEditor.Editor.CreateEditor(Manager);
                Gui.Act("Start Recording", true);
                Inspect(inspector, "button Stop Recording");
                Play(2);
                Gui.Act("Dump Recording", true);
                Inspect(inspector, "button Show Recordings");
                Gui.Act("Stop Recording", true);
                Inspect(inspector, "button Start Recording");
                Assert.That(Directory.GetFiles(Recorder.Folder, "collektive-*.jfr").Length, Is.EqualTo(1));
                Assert.That(Directory.GetFiles(Recorder.Folder, "dump-*.jfr").Length, Is.EqualTo(1));
                Gui.Act("Show Recordings", true);
                Gui.Passes(inspector.OnInspectorGUI);
                Assert.That(Project.Revealed, Is.EqualTo(Recorder.Folder));
                Gui.Act("Recording settings", "fastest");
                Gui.Act("Start Recording", true);
                Inspect(inspector, "help Error: flight recording: unknown settings 'fastest'; use default, profile or the path of a .jfc file");
            }
            finally
            {
                Directory.SetCurrentDirectory(before);
                Directory.Delete(folder, true);
            }
        }

        [Test]
        public void The_JVM_settings_show_effective_values_and_errors()
        {
            MakeThree();
            var asset = ScriptableObject.CreateInstance<Unity.JvmSettingsAsset>();
            var inspector = UnityEditor.Editor.CreateEditor(asset);
            InspectChecked(inspector);
            Assert.That(Gui.Lines, Has.Some.EqualTo("property Maximum heap (MB): 0"));
            Assert.That(Gui.Lines, Has.Some.EqualTo("label  : in effect: 256 MB"));
            Assert.That(Gui.Lines, Has.Some.Contains("Changes take effect " + TestJvm.WhenChangesTakeEffect));
            Inspect(inspector, "(disabled) button Restart JVM");
            Assert.That(Gui.Lines, Has.Some.EqualTo("label Placement: " + (Jvm.Process == 0 ? "in the editor's process" : "process " + Jvm.Process)));
            Assert.That(Gui.Lines, Has.None.Contains("help Error"));
            Gui.Act("Maximum heap (MB)", 3);
            Gui.Passes(inspector.OnInspectorGUI);
            Assert.That(asset.settings.maximumHeapMb, Is.EqualTo(3));
            InspectChecked(inspector);
            Assert.That(Gui.Lines, Has.Some.Contains("help Error: maximum heap is 3: it must be 16"));
        }

        [Test]
        public void The_inspector_of_a_JVMs_settings_survives_a_failed_check()
        {
            var asset = ScriptableObject.CreateInstance<Unity.JvmSettingsAsset>();
            asset.settings.location = JvmLocation.Folder;
            asset.settings.home = "no\0path";
            var inspector = UnityEditor.Editor.CreateEditor(asset);
            InspectChecked(inspector);
            Assert.That(Gui.Lines, Has.Some.StringStarting("help Error: The JVM settings could not be checked: "));
            asset.settings.location = JvmLocation.Automatic;
            InspectChecked(inspector);
            Assert.That(Gui.Lines, Has.None.StringStarting("help Error: The JVM settings could not"));
        }

        [Test]
        public void The_JVM_settings_can_be_edited_in_the_managers_inspector()
        {
            MakeThree();
            var inspector = UnityEditor.Editor.CreateEditor(Manager);
            Gui.Passes(inspector.OnInspectorGUI);
            Assert.That(Gui.Lines, Has.Some.EqualTo("foldout JVM settings: closed"));
            Gui.Act("JVM settings", true);
            Gui.Act("Maximum heap (MB)", 512);
            Gui.Passes(inspector.OnInspectorGUI);
            Assert.That(Manager.Settings.jvm.settings.maximumHeapMb, Is.EqualTo(512));
        }

        /// <summary>Draws the settings of a JVM, waits until another thread has checked them, and draws them again.</summary>
        private static void InspectChecked(UnityEditor.Editor inspector)
        {
            Gui.Passes(inspector.OnInspectorGUI);
            do
            {
                Menus.Tick();
                System.Threading.Thread.Sleep(1);
            }
            while (EditorApplication.update != null);
            Gui.Clear();
            Gui.Passes(inspector.OnInspectorGUI);
        }

        /// <summary>Draws the inspector until a control appears. The loop is needed because starting or writing a recording takes time.</summary>
        private static void Inspect(UnityEditor.Editor inspector, string awaited)
        {
            var clock = System.Diagnostics.Stopwatch.StartNew();
            do
            {
                Gui.Clear();
                Gui.Passes(inspector.OnInspectorGUI);
                foreach (var line in Gui.Lines)
                {
                    if (line == awaited) return;
                }
                System.Threading.Thread.Sleep(50);
            }
            while (clock.Elapsed.TotalSeconds < 30);
            Assert.Fail("'" + awaited + "' did not appear: " + string.Join("\n", Gui.Lines));
        }

        /// <summary>Creates three nodes and runs a tick. Nodes 0 and 1 exchange messages, and node 2 receives messages from node 0.</summary>
        private List<ProbeNode> MakeThree()
        {
            var nodes = new List<ProbeNode> { MakeNode(1), MakeNode(2, Vector3.right), MakeNode(3, 2 * Vector3.right) };
            Manager.AddLink(0, 1);
            Manager.AddLink(0, 2, directed: true);
            Play(1);
            return nodes;
        }

        private static List<string> Rows() => new List<string>(Gui.Lines).FindAll(line => line.StartsWith("row "));

        private static void Draw()
        {
            Gui.Clear();
            Menus.Draw(DiagnosticsWindow.Open());
        }

        private static MultiColumnListView Table => DiagnosticsWindow.Open().rootVisualElement.Children().OfType<MultiColumnListView>().Single();

        /// <summary>Draws the window until a control appears. The loop is needed because another thread queries the JVM.</summary>
        private static void AwaitInWindow(string start)
        {
            var clock = System.Diagnostics.Stopwatch.StartNew();
            do
            {
                Draw();
                foreach (var line in Gui.Lines)
                {
                    if (line.StartsWith(start)) return;
                }
                System.Threading.Thread.Sleep(50);
            }
            while (clock.Elapsed.TotalSeconds < 30);
            Assert.Fail("'" + start + "' did not appear: " + string.Join("\n", Gui.Lines));
        }

        private sealed class BrokenSensor : Unity.Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data) => throw new System.InvalidOperationException("out of order");
        }
    }
}
