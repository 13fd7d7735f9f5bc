using System;
using System.Collections.Generic;
using System.Text;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Logs the errors of a simulation, and counts them by source and node. A source is a program or a component. The last message of each source and node
    /// is kept. The counts of nodes that have left are combined, so that memory does not grow in scenes whose nodes come and go.
    /// </summary>
    internal sealed class ErrorCounts
    {
        private readonly Dictionary<int, List<NodeErrors>> places = new Dictionary<int, List<NodeErrors>>();
        private readonly List<NodeErrors> all = new List<NodeErrors>();
        private readonly RepeatedErrors repeated = new RepeatedErrors();

        internal IReadOnlyList<NodeErrors> All => all;

        internal long Count { get; private set; }

        /// <summary>Adds the error of a failed round. <paramref name="node"/> is null if the node has left.</summary>
        internal void AddRound(Node node, int id, string program, ulong tick, string message)
        {
            if (node != null) node.LastError = message;
            Count++;
            PlaceOf(program, node == null ? NodeErrors.DepartedNodes : id).Add(1, tick, message);
            if (repeated.IsFirst(KeyOf(program, message), "rounds of program '" + program + "' failed in the same way", id, FirstLine(message)))
                Debug.LogError("round of node " + id + " (program '" + program + "') failed at tick " + tick + ": " + message, node);
        }

        /// <summary>Adds an exception that a sensor, actuator or rule threw.</summary>
        internal void AddPart(Node node, NodePart part, ulong tick, Exception error)
        {
            var source = part.GetType().Name;
            node.LastError = error.Message;
            Count++;
            // The component may have removed or destroyed its node. The error is then counted for NodeErrors.DepartedNodes.
            PlaceOf(source, node.Id).Add(1, tick, error.Message);
            if (repeated.IsFirst(KeyOf(source, error), "calls of " + source + " failed in the same way", node.Id, error.GetType() + ": " + error.Message))
            {
                var name = node == null ? "destroyed" : node.name;
                var message = source + " of node " + node.Id + " ('" + name + "') failed at tick " + tick + ": " + error.Message;
                Debug.LogException(new InvalidOperationException(message, error), part);
            }
            if (part == null || !part.HasFailedTooOften()) return;
            var disabled = source + " on '" + part.name + "' failed " + NodePart.MaxFailuresInRow + " times in a row and is disabled";
            if (repeated.IsFirst("disabled " + source, "components " + source + " were disabled for the same reason", node.Id, disabled))
                Debug.LogError(disabled + ": fix the component, then enable it again", part);
            part.enabled = false;
        }

        /// <summary>Adds an exception that a handler of <see cref="SimulationManager.Ticked"/> or a stop condition threw.</summary>
        /// <param name="source">The handler's class and method.</param>
        internal void AddHandler(string source, ulong tick, Exception error, UnityEngine.Object context)
        {
            Count++;
            PlaceOf(source, NodeErrors.NoNode).Add(1, tick, error.Message);
            Debug.LogException(new InvalidOperationException(source + " failed after tick " + tick + ": " + error.Message, error), context);
        }

        /// <summary>Adds the counts of a node to the combined counts of nodes that have left.</summary>
        internal void Leave(int node)
        {
            if (!places.TryGetValue(node, out var left)) return;
            places.Remove(node);
            foreach (var errors in left)
            {
                PlaceOf(errors.Source, NodeErrors.DepartedNodes).Add(errors.Count, errors.LastTick, errors.LastMessage);
                Remove(errors);
            }
        }

        /// <summary>Logs how often errors were repeated.</summary>
        internal void LogCounts() => repeated.LogCounts();

        /// <summary>
        /// Returns a key that is the same for errors with the same program, exception and code location. If the message has a stack trace, its text is not
        /// part of the key, because it may contain varying numbers.
        /// </summary>
        private static string KeyOf(string program, string message)
        {
            var stack = message.IndexOf('\n');
            var words = message.IndexOf(':');
            return stack < 0 || words < 0 || words > stack ? program + message : program + message.Substring(0, words) + message.Substring(stack);
        }

        /// <summary>
        /// Returns a key that is the same for errors with the same component, exception, text and code location. Numbers in the text are ignored.
        /// </summary>
        private static string KeyOf(string source, Exception error)
        {
            var key = new StringBuilder(source).Append(error.GetType());
            foreach (var letter in error.Message)
            {
                if (!char.IsDigit(letter) && letter != '.' && letter != '-') key.Append(letter);
            }
            return key.Append(error.StackTrace).ToString();
        }

        private static string FirstLine(string message)
        {
            var end = message.IndexOf('\n');
            return end < 0 ? message : message.Substring(0, end);
        }

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

        /// <summary>
        /// Removes counts by moving the last entry of the list to their index. Removal must be fast, because thousands of nodes may leave at once.
        /// </summary>
        private void Remove(NodeErrors errors)
        {
            var last = all[all.Count - 1];
            all[errors.Index] = last;
            last.Index = errors.Index;
            all.RemoveAt(all.Count - 1);
        }
    }

    /// <summary>
    /// The errors of one program, sensor, actuator or rule, on one node or on all nodes that have left. Also used for the errors of one handler of <see
    /// cref="SimulationManager.Ticked"/>.
    /// </summary>
    public sealed class NodeErrors
    {
        /// <summary>Value of <see cref="Node"/> for the combined errors of nodes that have left.</summary>
        public const int DepartedNodes = -1;

        /// <summary>Value of <see cref="Node"/> for the errors of a handler, which belongs to no node.</summary>
        public const int NoNode = -2;

        internal NodeErrors(string source, int node)
        {
            Source = source;
            Node = node;
        }

        /// <summary>The program's name, the component's type, or the handler's class and method.</summary>
        public string Source { get; }

        /// <summary>The node's id, <see cref="DepartedNodes"/> or <see cref="NoNode"/>.</summary>
        public int Node { get; }

        /// <summary>Number of errors.</summary>
        public long Count { get; private set; }

        /// <summary>Tick of the last error.</summary>
        public ulong LastTick { get; private set; }

        /// <summary>Message of the last error.</summary>
        public string LastMessage { get; private set; } = "";

        /// <summary>Index in the list of all errors.</summary>
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
