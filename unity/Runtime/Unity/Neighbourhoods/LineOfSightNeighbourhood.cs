using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes within a radius; each collider on the straight line between the two centres adds to the link's attenuation, or
    /// prevents the link. The two nodes' own colliders and triggers do not count; bodies of other nodes do, unless their layer is
    /// excluded. It costs one ray for each pair of nodes and tick.
    /// </summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Line Of Sight Neighbourhood")]
    public sealed class LineOfSightNeighbourhood : NeighbourhoodRule
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Metres.")]
        private float radius = 3;

        [SerializeField]
        [Tooltip("Layers of obstructing colliders.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        [SerializeField]
        [Tooltip("On: an obstructing collider prevents the link. Off: it increases the link's attenuation.")]
        private bool blocking = true;

        [SerializeField]
        [Min(0)]
        [Tooltip("Increase of the link's attenuation for each obstructing collider. Without colliders the attenuation is 0.")]
        private float attenuation = 1;

        // The nodes that were near when the lines of the tick were cast.
        private readonly GrowingArray<(NearNode Near, int Line)> seen = new GrowingArray<(NearNode Near, int Line)>();

        /// <summary>The radius in metres, 0 or greater.</summary>
        public float Radius
        {
            get => radius;
            set => radius = value;
        }

        /// <summary>Layers of obstructing colliders.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <summary>Whether an obstructing collider prevents the link. Otherwise it increases the link's attenuation.</summary>
        public bool Blocking
        {
            get => blocking;
            set => blocking = value;
        }

        /// <summary>Increase of the link's attenuation for each obstructing collider, 0 or greater.</summary>
        public float Attenuation
        {
            get => attenuation;
            set => attenuation = value;
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours)
        {
            var sight = Node.Simulation.SightLines;
            if (!sight.Rules.Has(this))
            {
                // The rule was added in this tick.
                AddWithoutBatch(neighbours, sight);
                return;
            }
            for (var i = 0; i < seen.Count; i++)
            {
                ref var node = ref seen.Items[i];
                Add(neighbours, node.Near, sight.ObstaclesOf(node.Line));
            }
        }

        internal override void Enqueue()
        {
            var simulation = Node.Simulation;
            seen.Clear();
            var near = simulation.Grid.Find(Node.Position, radius);
            for (var i = 0; i < near.Length; i++)
            {
                if (near[i].Id == Node.Id) continue;
                ref var node = ref seen.Add();
                node.Near = near[i];
                node.Line = simulation.SightLines.Ask(Node, simulation.Grid.NodeAt(near[i]), layers, near[i].Distance);
            }
        }

        private void AddWithoutBatch(NeighbourCollector neighbours, SightLines sight)
        {
            var near = neighbours.FindWithin(radius);
            for (var i = 0; i < near.Length; i++)
            {
                if (near[i].Id != Node.Id)
                    Add(neighbours, near[i], sight.CountObstacles(Node, neighbours.NodeOf(near[i]), layers, near[i].Distance));
            }
        }

        private void Add(NeighbourCollector neighbours, in NearNode near, int obstacles)
        {
            if (!blocking || obstacles == 0) neighbours.Add(near, obstacles * attenuation);
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, radius);
    }
}
