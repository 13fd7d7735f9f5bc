using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Selects the nodes within a radius as neighbours. Each collider on the straight line between the two centres increases the link's
    /// attenuation, or prevents the link. Triggers and the colliders of the two nodes do not obstruct the line, but bodies of other nodes do, unless their
    /// layer is excluded. The rule casts one ray per pair of nodes and tick, from the node with the lower id. A collider that contains the centre of this
    /// node is not counted.
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

        // The near nodes with the lines to them, which are set when the queries begin, and the obstacles on these lines, which are set when the rule is called.
        private readonly GrowingArray<(NearNode Near, int Line, int Obstacles)> near = new GrowingArray<(NearNode Near, int Line, int Obstacles)>();

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
            for (var i = 0; i < near.Count; i++)
            {
                ref var node = ref near.Items[i];
                // Without the condition, an infinite attenuation would result in NaN.
                if (node.Obstacles == 0) neighbours.Add(node.Near);
                else if (!blocking) neighbours.Add(node.Near, node.Obstacles * attenuation);
            }
        }

        internal override void Enqueue(TickContext tick)
        {
            FindNear(tick);
            for (var i = 0; i < near.Count; i++)
            {
                ref var node = ref near.Items[i];
                node.Line = tick.SightLines.Request(Node, tick.Grid.NodeAt(node.Near), layers, node.Near.Distance);
            }
        }

        internal override void Prepare(TickContext tick)
        {
            CheckNotNegative("radius", radius);
            // A rule is not yet in the batch in the tick that added it.
            var isBatched = tick.SightLines.Rules.Has(this);
            if (!isBatched) FindNear(tick);
            for (var i = 0; i < near.Count; i++)
            {
                ref var node = ref near.Items[i];
                node.Obstacles = isBatched ? tick.SightLines.ObstaclesOf(node.Line)
                    : tick.SightLines.CountObstacles(Node, tick.Grid.NodeAt(node.Near), layers, node.Near.Distance);
            }
        }

        private void FindNear(TickContext tick)
        {
            near.Clear();
            var found = tick.Grid.Find(Node.Position, radius);
            for (var i = 0; i < found.Length; i++)
            {
                if (found[i].Id != Node.Id) near.Add().Near = found[i];
            }
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, radius);
    }
}
