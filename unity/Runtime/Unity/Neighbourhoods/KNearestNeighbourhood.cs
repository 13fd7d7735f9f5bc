using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes nearest to this one, wherever they are; at equal distances the smaller id comes first. The relation is
    /// not symmetric. Unless the rule is directed, links go both ways, so a node can have more than <see cref="Count"/> neighbours.
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
