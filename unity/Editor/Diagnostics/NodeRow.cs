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

        /// <summary>Equal to null if it has been destroyed since.</summary>
        internal Node Node { get; }

        internal int Id { get; }

        internal string Name => Node == null ? "(destroyed)" : Node.name;

        /// <summary>The node's last error, or an empty text.</summary>
        internal string Error => Node == null ? "" : Node.LastError;

        /// <summary>Its own program, or the manager's.</summary>
        internal string Program { get; }

        /// <summary>Number of nodes that it receives messages from.</summary>
        internal int SenderCount { get; }

        /// <summary>Number of nodes that receive its messages.</summary>
        internal int ReceiverCount { get; }
    }
}
