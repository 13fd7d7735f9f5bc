namespace Collektive.Unity.Editor
{
    /// <summary>A node in the diagnostics window.</summary>
    internal readonly struct NodeRow
    {
        internal NodeRow(Node node, string program, int senderCount, int receiverCount)
        {
            Node = node;
            Id = node.Id;
            Program = program;
            SenderCount = senderCount;
            ReceiverCount = receiverCount;
        }

        /// <summary>The node. It compares equal to null if it was destroyed in the meantime.</summary>
        internal Node Node { get; }

        internal int Id { get; }

        internal string Name => Node == null ? "(destroyed)" : Node.name;

        /// <summary>The node's last error, or an empty string.</summary>
        internal string Error => Node == null ? "" : Node.LastError;

        /// <summary>Name of the program that the node runs.</summary>
        internal string Program { get; }

        /// <summary>Number of nodes from which the node receives messages.</summary>
        internal int SenderCount { get; }

        /// <summary>Number of nodes that receive the node's messages.</summary>
        internal int ReceiverCount { get; }
    }
}
