using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Selects the nodes whose centres lie within a radius of this node's centre as neighbours.</summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Radius Neighbourhood")]
    public sealed class RadiusNeighbourhood : NeighbourhoodRule
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Metres.")]
        private float radius = 3;

        /// <summary>The radius in metres, 0 or greater.</summary>
        public float Radius
        {
            get => radius;
            set => radius = value;
        }

        internal override bool IsSearch => radius >= 0;

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours) => neighbours.SearchWithin(radius);

        internal override void Prepare(TickContext tick) => CheckNotNegative("radius", radius);

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, radius);
    }
}
