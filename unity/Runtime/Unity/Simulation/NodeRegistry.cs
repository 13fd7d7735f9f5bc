using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The nodes of a simulation, including the nodes that joined or left since the last tick.</summary>
    internal sealed class NodeRegistry
    {
        /// <summary>The link view stores a node in 24 bits.</summary>
        private const int MaxId = (1 << 24) - 1;

        private readonly List<Node> nodes = new List<Node>();
        // Contains null for nodes that left again.
        private readonly List<Node> joining = new List<Node>();
        private readonly PagedArray<int> joiningIndex = new PagedArray<int>();
        private readonly GrowingArray<int> leaving = new GrowingArray<int>();
        private readonly GrowingArray<int> departed = new GrowingArray<int>();
        private readonly PagedArray<bool> isGone = new PagedArray<bool>();
        private int nextId;

        /// <summary>The participating nodes, ascending by id.</summary>
        internal List<Node> Nodes => nodes;

        /// <summary>The nodes that joined since the last tick. Contains null for nodes that left again.</summary>
        internal IReadOnlyList<Node> Joining => joining;

        /// <summary>Called with each node and its parameters when they are sent to the JVM.</summary>
        internal Action<Node, List<NodeParameter>> Joined { get; set; }

        /// <summary>A number that is greater than all ids.</summary>
        internal int IdCapacity => nextId;

        /// <summary>Whether a node was sent to the JVM, indexed by id.</summary>
        internal PagedArray<bool> IsKnown { get; } = new PagedArray<bool>();

        /// <summary>Returns the node with the given id, or null.</summary>
        internal Node Find(int id)
        {
            var index = IndexOf(id);
            return index < 0 ? null : nodes[index];
        }

        /// <summary>Adds a node with its requested id, or the next free one.</summary>
        /// <returns>The error of the requested id, or null if the node was added.</returns>
        internal string Join(Node node, Simulation simulation)
        {
            var id = node.RequestedId >= 0 ? node.RequestedId : nextId;
            if (id > MaxId) return "node '" + node.name + "' has id " + id + ", but the largest id is " + MaxId + ": use smaller ids, or -1";
            var index = ~IndexOf(id);
            if (index < 0) return "node '" + node.name + "' has id " + id + ", which node '" + nodes[~index].name
                + "' already uses: give each node its own id, or -1";
            nextId = Math.Max(nextId, id + 1);
            if (isGone[id]) DropLinksOfDeparted(simulation.Links);
            node.OnJoined(simulation, id);
            nodes.Insert(index, node);
            joiningIndex[id] = joining.Count;
            joining.Add(node);
            return null;
        }

        /// <summary>Frees an id for the next node if it is the greatest one.</summary>
        internal void FreeLast(int id)
        {
            if (id == nextId - 1) nextId = id;
        }

        /// <summary>Removes a node. Its links are kept until <see cref="DropLinksOfDeparted"/> removes them.</summary>
        internal void Leave(Node node, NeighbourSearch links)
        {
            var id = node.Id;
            nodes.RemoveAt(IndexOf(id));
            if (IsKnown[id]) leaving.Add(id);
            else joining[joiningIndex[id]] = null;
            IsKnown[id] = false;
            links.Know(id, false);
            isGone[id] = true;
            departed.Add(id);
        }

        /// <summary>Removes the links of all nodes that left, in one pass over all links.</summary>
        internal void DropLinksOfDeparted(NeighbourSearch links)
        {
            if (departed.Count == 0) return;
            links.Drop(new Span<int>(departed.Items, 0, departed.Count));
            for (var i = 0; i < departed.Count; i++) isGone[departed.Items[i]] = false;
            departed.Clear();
        }

        /// <summary>Writes the nodes that left or joined since the last call to the request.</summary>
        internal void Flush(StepRequest request, NeighbourSearch links)
        {
            for (var i = 0; i < leaving.Count; i++) request.RemoveNode(leaving.Items[i]);
            leaving.Clear();
            if (joining.Count == 0) return;
            WarnIfAtOnePosition();
            for (var i = 0; i < joining.Count; i++)
            {
                if (joining[i] is null) continue;
                joining[i].KeepProgram();
                var parameters = joining[i].Simulation.Settings.ParametersOf(joining[i]);
                request.AddNode(joining[i].Id, joining[i].Program, Pairs(parameters));
                Joined?.Invoke(joining[i], parameters);
                IsKnown[joining[i].Id] = true;
                links.Know(joining[i].Id, true);
            }
            joining.Clear();
        }

        /// <summary>Resends the parameters of all nodes that run a program.</summary>
        public void ChangeParameters(StepRequest request, string program)
        {
            foreach (var node in nodes)
            {
                var settings = node.Simulation.Settings;
                if (IsKnown[node.Id] && settings.ProgramOf(node) == program) request.ChangeNode(node.Id, node.UsedProgram, Pairs(settings.ParametersOf(node)));
            }
        }

        /// <summary>Warns about a scene whose nodes all have the same position, because they are then neighbours at any radius.</summary>
        private void WarnIfAtOnePosition()
        {
            if (nodes.Count < 2) return;
            var place = nodes[0].Body.position;
            for (var i = 1; i < nodes.Count; i++)
            {
                if (nodes[i].Body.position != place) return;
            }
            Debug.LogWarning("all " + nodes.Count + " nodes have the same position, " + place + ": give them different positions", nodes[0]);
        }

        private static KeyValuePair<string, string>[] Pairs(List<NodeParameter> values)
        {
            var parameters = new KeyValuePair<string, string>[values.Count];
            // Unity does not serialise null, but scripts may leave a name or a value out.
            for (var i = 0; i < parameters.Length; i++) parameters[i] = new KeyValuePair<string, string>(values[i].name ?? "", values[i].value ?? "");
            return parameters;
        }

        private int IndexOf(int id)
        {
            var low = 0;
            var high = nodes.Count - 1;
            while (low <= high)
            {
                var middle = (low + high) / 2;
                if (nodes[middle].Id == id) return middle;
                if (nodes[middle].Id < id) low = middle + 1;
                else high = middle - 1;
            }
            return ~low;
        }
    }
}
