using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>A link of the selected node.</summary>
    internal readonly struct NeighbourRow
    {
        internal NeighbourRow(int id, bool isSender, LinkRecord link)
        {
            Id = id;
            IsSender = isSender;
            Link = link;
        }

        /// <summary>Id of the node at the other end.</summary>
        internal int Id { get; }

        /// <summary>Whether the other node is the sender. Otherwise, it is the receiver.</summary>
        internal bool IsSender { get; }

        internal LinkRecord Link { get; }
    }
}
