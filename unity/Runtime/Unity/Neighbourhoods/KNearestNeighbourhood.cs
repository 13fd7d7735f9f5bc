using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes nearest to this one, at any distance; at equal distances the smaller id comes first. The relation is not symmetric. Unless the
    /// rule is directed, links go both ways, so a node can have more than <see cref="Count"/> neighbours.
    /// </summary>
    [AddComponentMenu("Collektive/Neighbourhoods/K Nearest Neighbourhood")]
    public sealed class KNearestNeighbourhood : NeighbourhoodRule
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Number of neighbours.")]
        private int count = 8;

        /// <summary>Number of neighbours, 0 or more.</summary>
        public int Count
        {
            get => count;
            set => count = value;
        }

        internal override bool IsSearch => true;

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours) => neighbours.SearchNearest(count);
    }
}
