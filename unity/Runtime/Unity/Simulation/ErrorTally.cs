using System.Collections.Generic;

namespace Collektive.Unity
{
    /// <summary>Counts errors by where they come from; it keeps the last message of each place.</summary>
    internal sealed class ErrorTally
    {
        private readonly Dictionary<(string, int), NodeErrors> places = new Dictionary<(string, int), NodeErrors>();
        private readonly List<NodeErrors> all = new List<NodeErrors>();

        internal IReadOnlyList<NodeErrors> All => all;

        internal long Count { get; private set; }

        internal void Add(string source, int node, ulong tick, string message)
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

        internal void Clear()
        {
            places.Clear();
            all.Clear();
            Count = 0;
        }
    }

    /// <summary>The errors of one program, sensor, actuator or rule on one node.</summary>
    public sealed class NodeErrors
    {
        internal NodeErrors(string source, int node)
        {
            Source = source;
            Node = node;
        }

        /// <summary>The program's name, or the component's type.</summary>
        public string Source { get; }

        /// <summary>The node's id.</summary>
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
