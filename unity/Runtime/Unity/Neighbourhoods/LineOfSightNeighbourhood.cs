using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes within a radius; each collider on the straight line between the two centres adds to the link's attenuation, or
    /// prevents the link. The two nodes' own colliders and triggers are passed over; bodies of other nodes count, unless they are on a
    /// layer that is not looked at. It costs one ray for each neighbour and tick.
    /// </summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Line Of Sight Neighbourhood")]
    public sealed class LineOfSightNeighbourhood : NeighbourhoodRule
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Metres.")]
        private float radius = 3;

        [SerializeField]
        [Tooltip("Layers of the colliders that stand in the way.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        [SerializeField]
        [Tooltip("On: a collider in the way prevents the link. Off: it adds to the link's attenuation.")]
        private bool blocking = true;

        [SerializeField]
        [Min(0)]
        [Tooltip("What each collider in the way adds to the link's attenuation, which is 0 when the way is clear.")]
        private float attenuation = 1;

        /// <summary>The radius in metres, 0 or greater.</summary>
        public float Radius
        {
            get => radius;
            set => radius = value;
        }

        /// <summary>Layers of the colliders that stand in the way.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <summary>Whether a collider in the way prevents the link; if not, it adds to the link's attenuation.</summary>
        public bool Blocking
        {
            get => blocking;
            set => blocking = value;
        }

        /// <summary>What each collider in the way adds to the link's attenuation, 0 or greater.</summary>
        public float Attenuation
        {
            get => attenuation;
            set => attenuation = value;
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(SimulationManager manager)
        {
            var body = Node.Body;
            var here = body.position;
            var hits = Node.Simulation.Grid.Find(here, radius);
            for (var i = 0; i < hits.Length; i++)
            {
                if (hits[i].Id == Node.Id) continue;
                var obstacles = CountObstacles(here, body, Node.Simulation.Grid.NodeAt(hits[i]).Body, hits[i].Distance);
                if (blocking && obstacles > 0) continue;
                Connect(hits[i].Id, hits[i].Distance, obstacles * attenuation);
            }
        }

        private int CountObstacles(Vector3 here, Transform body, Transform other, float distance)
        {
            ref var inTheWay = ref Node.Simulation.QueryMemory.InTheWay;
            int found;
            // A full array may have left some out.
            while ((found = Physics.RaycastNonAlloc(here, other.position - here, inTheWay, distance, layers,
                QueryTriggerInteraction.Ignore)) == inTheWay.Length)
            {
                inTheWay = new RaycastHit[2 * inTheWay.Length];
            }
            var obstacles = 0;
            for (var i = 0; i < found; i++)
            {
                var hit = inTheWay[i].collider.transform;
                if (!hit.IsChildOf(body) && !hit.IsChildOf(other)) obstacles++;
            }
            return obstacles;
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, radius);
    }
}
