using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Logs and counts the errors of a simulation, by where they come from; it keeps the last message of each place. Places are programs and components of
    /// nodes that take part. Those of nodes that have left are added up, so that a scene whose nodes come and go does not fill the memory.
    /// </summary>
    internal sealed class ErrorTally
    {
        private readonly Dictionary<int, List<NodeErrors>> places = new Dictionary<int, List<NodeErrors>>();
        private readonly List<NodeErrors> all = new List<NodeErrors>();
        private readonly RepeatedErrors rounds = new RepeatedErrors();

        internal IReadOnlyList<NodeErrors> All => all;

        internal long Count { get; private set; }

        /// <summary>A round failed; <paramref name="node"/> is null when its node has left.</summary>
        internal void AddRound(Node node, int id, string program, ulong tick, string message)
        {
            if (node != null) node.LastError = message;
            Count++;
            PlaceOf(program, node == null ? NodeErrors.Left : id).Add(1, tick, message);
            rounds.Report(id, program, tick, message, node);
        }

        /// <summary>A sensor, actuator or rule threw an exception.</summary>
        internal void AddPart(Node node, NodePart part, ulong tick, Exception error)
        {
            var source = part.GetType().Name;
            node.LastError = error.Message;
            Count++;
            // Its own code may have made the node leave: then the id is that of those that have left.
            PlaceOf(source, node.Id).Add(1, tick, error.Message);
            Debug.LogException(
                new InvalidOperationException(source + " of node " + node.Id + " ('" + node.name + "') failed at tick " + tick + ": " + error.Message, error),
                part);
            part.Failed();
        }

        /// <summary>A handler of <see cref="SimulationManager.Ticked"/> or a stop condition threw an exception.</summary>
        /// <param name="source">The handler's class and method.</param>
        internal void AddHandler(string source, ulong tick, Exception error, UnityEngine.Object context)
        {
            Count++;
            PlaceOf(source, NodeErrors.NoNode).Add(1, tick, error.Message);
            Debug.LogException(new InvalidOperationException(source + " failed after tick " + tick + ": " + error.Message, error), context);
        }

        /// <summary>Adds what is counted for a node to that of the nodes that have left before.</summary>
        internal void Leave(int node)
        {
            if (!places.TryGetValue(node, out var left)) return;
            places.Remove(node);
            foreach (var errors in left)
            {
                PlaceOf(errors.Source, NodeErrors.Left).Add(errors.Count, errors.LastTick, errors.LastMessage);
                Remove(errors);
            }
        }

        /// <summary>Logs how often errors of rounds have come that were not logged each time.</summary>
        internal void TellCounts() => rounds.TellCounts();

        private NodeErrors PlaceOf(string source, int node)
        {
            if (!places.TryGetValue(node, out var ofNode)) places.Add(node, ofNode = new List<NodeErrors>(1));
            foreach (var each in ofNode)
            {
                if (each.Source == source) return each;
            }
            var errors = new NodeErrors(source, node) { Index = all.Count };
            ofNode.Add(errors);
            all.Add(errors);
            return errors;
        }

        /// <summary>The last one takes its index: thousands may leave at once.</summary>
        private void Remove(NodeErrors errors)
        {
            var last = all[all.Count - 1];
            all[errors.Index] = last;
            last.Index = errors.Index;
            all.RemoveAt(all.Count - 1);
        }
    }

    /// <summary>
    /// The errors of one program, sensor, actuator or rule on one node, or on all nodes that have left; or of one handler of
    /// <see cref="SimulationManager.Ticked"/>.
    /// </summary>
    public sealed class NodeErrors
    {
        /// <summary><see cref="Node"/> of the errors of all nodes that have left.</summary>
        public const int Left = -1;

        /// <summary><see cref="Node"/> of the errors of a handler, which belongs to no node.</summary>
        public const int NoNode = -2;

        internal NodeErrors(string source, int node)
        {
            Source = source;
            Node = node;
        }

        /// <summary>The program's name, the component's type, or the handler's class and method.</summary>
        public string Source { get; }

        /// <summary>The node's id, <see cref="Left"/> or <see cref="NoNode"/>.</summary>
        public int Node { get; }

        /// <summary>How many there were.</summary>
        public long Count { get; private set; }

        /// <summary>The tick of the last one.</summary>
        public ulong LastTick { get; private set; }

        /// <summary>The message of the last one.</summary>
        public string LastMessage { get; private set; } = "";

        /// <summary>Where it is in the list of all.</summary>
        internal int Index { get; set; }

        internal void Add(long count, ulong tick, string message)
        {
            Count += count;
            if (tick < LastTick) return;
            LastTick = tick;
            LastMessage = message;
        }
    }
}
