using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes within a radius; each collider on the straight line between the two centres adds to the link's attenuation, or
    /// prevents the link. The two nodes' own colliders and triggers are passed over; bodies of other nodes count, unless they are on a
    /// layer that is not looked at. It costs one ray for each pair of nodes and tick, whichever of the two asks first.
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
        protected override void FindNeighbours(NeighbourCollector neighbours)
        {
            var near = neighbours.FindWithin(radius);
            for (var i = 0; i < near.Length; i++)
            {
                if (near[i].Id == Node.Id) continue;
                var obstacles = CountObstacles(neighbours.NodeOf(near[i]), near[i].Distance);
                if (!blocking || obstacles == 0) neighbours.Add(near[i], obstacles * attenuation);
            }
        }

        private int CountObstacles(Node other, float distance)
        {
            ref var obstacles = ref Node.Simulation.SightLines.Between(Node.Id, other.Id, layers);
            // Always the same way round: a ray does not see a collider that it begins in.
            if (obstacles == SightLines.Unknown) obstacles = Node.Id < other.Id ? Cast(Node, other, distance) : Cast(other, Node, distance);
            return obstacles;
        }

        private int Cast(Node from, Node to, float distance)
        {
            ref var inTheWay = ref Node.Simulation.QueryMemory.InTheWay;
            int found;
            // A full array may have left some out.
            while ((found = Physics.RaycastNonAlloc(from.Position, to.Position - from.Position, inTheWay, distance, layers,
                QueryTriggerInteraction.Ignore)) == inTheWay.Length)
            {
                inTheWay = new RaycastHit[2 * inTheWay.Length];
            }
            var obstacles = 0;
            for (var i = 0; i < found; i++)
            {
                var hit = inTheWay[i].collider.transform;
                if (!hit.IsChildOf(from.Body) && !hit.IsChildOf(to.Body)) obstacles++;
            }
            return obstacles;
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, radius);
    }
}
