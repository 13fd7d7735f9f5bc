using System;
using System.Collections.Generic;
using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>Collects the data of the diagnostics window for one manager.</summary>
    internal sealed class Diagnostics : IDisposable
    {
        internal const int LogLines = 500;

        private readonly List<LinkRecord> links = new List<LinkRecord>();
        private readonly List<NodeRow> rows = new List<NodeRow>();
        // Numbers of links, by node id.
        private readonly PagedArray<(int Senders, int Receivers)> counts = new PagedArray<(int Senders, int Receivers)>();
        private readonly Queue<string> log = new Queue<string>();

        internal Diagnostics(SimulationManager manager)
        {
            Manager = manager;
            manager.Ticked += Ticked;
            manager.Logged += Logged;
        }

        internal SimulationManager Manager { get; }

        internal TimeAverages Times { get; } = new TimeAverages();

        /// <summary>The last lines of the JVM's log, the oldest first.</summary>
        internal IReadOnlyCollection<string> Log => log;

        /// <inheritdoc/>
        public void Dispose()
        {
            Manager.Ticked -= Ticked;
            Manager.Logged -= Logged;
        }

        /// <summary>Returns the nodes whose id, name or program contains the filter. The list is valid until the next call.</summary>
        internal List<NodeRow> Nodes(string filter)
        {
            CountLinks();
            rows.Clear();
            for (var i = 0; i < Manager.Nodes.Count; i++)
            {
                var node = Manager.Nodes[i];
                var program = Manager.Settings.ProgramOf(node);
                if (!Matches(node, program, filter)) continue;
                var (senders, receivers) = counts[node.Id];
                rows.Add(new NodeRow(node, program, senders, receivers));
            }
            return rows;
        }

        /// <summary>Returns the links of a node. Incoming links come first; both groups are sorted by the id of the other node.</summary>
        internal List<NeighbourRow> Neighbours(int id)
        {
            Manager.CopyLinks(links);
            var rows = new List<NeighbourRow>();
            foreach (var link in links)
            {
                if (link.To == id) rows.Add(new NeighbourRow(link.From, true, link));
                if (link.From == id) rows.Add(new NeighbourRow(link.To, false, link));
            }
            rows.Sort((a, b) => a.IsSender == b.IsSender ? a.Id.CompareTo(b.Id) : a.IsSender ? -1 : 1);
            return rows;
        }

        /// <summary>Returns a heading with the tick of the node's last answer.</summary>
        internal static string TitleOf(Node node) => node.AnswerTick == 0 ? "No answer yet" : "Answer of tick " + node.AnswerTick;

        /// <summary>Returns the last answer of a node's program, or an empty list before the first answer.</summary>
        internal List<KeyValuePair<string, string>> Values(int id)
        {
            var node = Manager.Find(id);
            var data = node == null ? null : node.Answer;
            return data == null ? new List<KeyValuePair<string, string>>() : DataText.Of(data);
        }

        /// <summary>Returns the errors by source and node, the most frequent first.</summary>
        internal List<NodeErrors> Errors()
        {
            var errors = new List<NodeErrors>(Manager.Errors);
            errors.Sort((a, b) => a.Count != b.Count ? b.Count.CompareTo(a.Count) : a.Node.CompareTo(b.Node));
            return errors;
        }

        private static bool Matches(Node node, string program, string filter) =>
            filter.Length == 0 || node.Id.ToString() == filter || Contains(node.name, filter) || Contains(program, filter);

        private static bool Contains(string text, string part) => text.IndexOf(part, StringComparison.OrdinalIgnoreCase) >= 0;

        private void CountLinks()
        {
            for (var i = 0; i < Manager.Nodes.Count; i++) counts[Manager.Nodes[i].Id] = default;
            var pairs = Manager.Simulation.PresentLinks.Pairs;
            for (var i = 0; i < pairs.Length; i++)
            {
                ref var pair = ref pairs[i];
                if (!pair.IsReferenced) continue;
                ref var low = ref counts[pair.Low];
                ref var high = ref counts[pair.High];
                if (pair.Up.References > 0)
                {
                    low.Receivers++;
                    high.Senders++;
                }
                if (pair.Down.References > 0)
                {
                    high.Receivers++;
                    low.Senders++;
                }
            }
        }

        private void Ticked(SimulationManager manager) => Times.Add(manager.Times, manager.HostMicros.Rounds / 1000.0);

        private void Logged(HostLogLevel level, string line)
        {
            if (log.Count == LogLines) log.Dequeue();
            log.Enqueue(level.ToString().ToLowerInvariant() + ": " + line);
        }
    }
}
