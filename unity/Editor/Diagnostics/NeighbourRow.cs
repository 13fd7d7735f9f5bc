using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>A link of the selected node.</summary>
    internal readonly struct NeighbourRow
    {
        internal NeighbourRow(int id, bool isHeard, LinkRecord link)
        {
            Id = id;
            IsHeard = isHeard;
            Link = link;
        }

        /// <summary>The node at the other end.</summary>
        internal int Id { get; }

        /// <summary>Whether the selected node hears the other one; else it is the other way round.</summary>
        internal bool IsHeard { get; }

        internal LinkRecord Link { get; }
    }
}
