using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes nearest to this one, wherever they are; at equal distances the smaller id comes first. A node may be among the
    /// nearest of another that is not among its own: unless the rule is directed, both hear each other then, and a node can have more
    /// neighbours than <see cref="Count"/>.
    /// </summary>
    [AddComponentMenu("Collektive/Neighbourhoods/K Nearest Neighbourhood")]
    public sealed class KNearestNeighbourhood : NeighbourhoodRule
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Number of neighbours.")]
        private int count = 8;

        private float reach;

        /// <summary>Number of neighbours, 0 or more.</summary>
        public int Count
        {
            get => count;
            set => count = value;
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours)
        {
            // One more than configured, since the node finds itself. The last search radius is a good guess.
            var nearest = neighbours.FindNearest(count < 1 ? 0 : count + 1, 1.25f * reach);
            reach = nearest.Length == 0 ? 0 : nearest[nearest.Length - 1].Distance;
            var left = count;
            for (var i = 0; i < nearest.Length && left > 0; i++)
            {
                if (nearest[i].Id == Node.Id) continue;
                neighbours.Add(nearest[i]);
                left--;
            }
        }
    }
}
