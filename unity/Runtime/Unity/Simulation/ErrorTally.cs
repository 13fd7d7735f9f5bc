using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Logs and counts the errors of a simulation, by where they come from; it keeps the last message of each place.</summary>
    internal sealed class ErrorTally
    {
        private readonly Dictionary<(string, int), NodeErrors> places = new Dictionary<(string, int), NodeErrors>();
        private readonly List<NodeErrors> all = new List<NodeErrors>();
        private readonly RepeatedErrors rounds = new RepeatedErrors();

        internal IReadOnlyList<NodeErrors> All => all;

        internal long Count { get; private set; }

        /// <summary>A round failed; <paramref name="node"/> is null when its node has left.</summary>
        internal void AddRound(Node node, int id, string program, ulong tick, string message)
        {
            if (node != null) node.LastError = message;
            Add(program, id, tick, message);
            rounds.Report(id, program, tick, message, node);
        }

        /// <summary>A sensor, actuator or rule threw an exception.</summary>
        internal void AddPart(Node node, NodePart part, ulong tick, Exception error)
        {
            var source = part.GetType().Name;
            node.LastError = error.Message;
            Add(source, node.Id, tick, error.Message);
            Debug.LogException(
                new InvalidOperationException(source + " of node " + node.Id + " ('" + node.name + "') failed at tick " + tick + ": " + error.Message, error),
                part);
            part.Failed();
        }

        /// <summary>A handler of <see cref="SimulationManager.Ticked"/> or a stop condition threw an exception.</summary>
        /// <param name="source">The handler's class and method.</param>
        internal void AddHandler(string source, ulong tick, Exception error, UnityEngine.Object context)
        {
            Add(source, NodeErrors.NoNode, tick, error.Message);
            Debug.LogException(new InvalidOperationException(source + " failed after tick " + tick + ": " + error.Message, error), context);
        }

        /// <summary>Logs how often errors of rounds have come that were not logged each time.</summary>
        internal void TellCounts() => rounds.TellCounts();

        private void Add(string source, int node, ulong tick, string message)
        {
            Count++;
            if (!places.TryGetValue((source, node), out var errors))
            {
                errors = new NodeErrors(source, node);
                places.Add((source, node), errors);
                all.Add(errors);
            }
            errors.Add(tick, message);
        }
    }

    /// <summary>The errors of one program, sensor, actuator or rule on one node, or of one handler of <see cref="SimulationManager.Ticked"/>.</summary>
    public sealed class NodeErrors
    {
        /// <summary>The <see cref="Node"/> of errors that belong to no node.</summary>
        internal const int NoNode = -1;

        internal NodeErrors(string source, int node)
        {
            Source = source;
            Node = node;
        }

        /// <summary>The program's name, the component's type, or the handler's class and method.</summary>
        public string Source { get; }

        /// <summary>The node's id; -1 for a handler, which belongs to no node.</summary>
        public int Node { get; }

        /// <summary>How many there were.</summary>
        public long Count { get; private set; }

        /// <summary>The tick of the last one.</summary>
        public ulong LastTick { get; private set; }

        /// <summary>The message of the last one.</summary>
        public string LastMessage { get; private set; } = "";

        internal void Add(ulong tick, string message)
        {
            Count++;
            LastTick = tick;
            LastMessage = message;
        }
    }
}
