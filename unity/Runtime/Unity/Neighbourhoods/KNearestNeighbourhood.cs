using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Selects the nodes nearest to this one as neighbours, at any distance. At equal distances, lower ids come first. The relation is not symmetric:
    /// unless the rule is directed, links also lead back, so a node can have more than <see cref="Count"/> neighbours.
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

        internal override bool IsSearch => count >= 0;

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours) => neighbours.SearchNearest(count);

        internal override void Prepare(TickContext tick) => CheckNotNegative("count", count);
    }
}
