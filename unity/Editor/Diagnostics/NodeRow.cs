namespace Collektive.Unity.Editor
{
    /// <summary>A node in the diagnostics window.</summary>
    internal readonly struct NodeRow
    {
        internal NodeRow(Node node, string program, int hears, int heard)
        {
            Node = node;
            Id = node.Id;
            Program = program;
            Hears = hears;
            Heard = heard;
        }

        /// <summary>Equal to null when it was destroyed since.</summary>
        internal Node Node { get; }

        internal int Id { get; }

        /// <summary>Its own program, or the manager's.</summary>
        internal string Program { get; }

        /// <summary>How many nodes it hears.</summary>
        internal int Hears { get; }

        /// <summary>How many nodes hear it.</summary>
        internal int Heard { get; }
    }
}
