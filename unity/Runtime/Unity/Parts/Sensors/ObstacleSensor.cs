using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Measures the closest point of each collider within reach of the node's centre. Bodies of other nodes are included; triggers and the node's own
    /// colliders are not. The closest point is exact for boxes, spheres, capsules and convex meshes. For other colliders, it is the closest point of their
    /// bounds.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ObstacleSensor<TData> : Sensor<TData>
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Reach from the node's centre, in metres.")]
        private float reach = 1;

        [SerializeField]
        [Tooltip("Layers of the measured colliders.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        // The index of this sensor's query in the batch, and the settings of the query.
        private int query;
        private float batchedReach;
        private LayerMask batchedLayers;
        private Obstacle[] found;
        private int foundCount;

        /// <summary>Maximum distance from the node's centre in metres, 0 or greater.</summary>
        public float Reach
        {
            get => reach;
            set => reach = value;
        }

        /// <summary>Layers of the measured colliders.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <summary>The reach for queries, because physics finds nothing within an infinite radius.</summary>
        private float FiniteReach => Mathf.Min(float.MaxValue, reach);

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) => Write(ref data, new Span<Obstacle>(found, 0, foundCount));

        internal sealed override void Prepare(TickContext tick)
        {
            CheckNotNegative("reach", reach);
            var queries = tick.Queries;
            // The batch is not used if another sensor changed the settings after the batch began.
            var isBatched = queries.Sensors.Has(this) && batchedReach == reach && batchedLayers == layers;
            if (!isBatched || !TryTakeHits(queries, out foundCount)) foundCount = Overlap(queries);
            found = queries.Obstacles;
        }

        internal sealed override void Enqueue(TickContext tick)
        {
            (batchedReach, batchedLayers) = (reach, layers);
            var parameters = new QueryParameters(layers, false, QueryTriggerInteraction.Ignore);
            query = tick.Queries.Spheres.Add(new OverlapSphereCommand(Node.Position, FiniteReach, parameters));
        }

        /// <summary>Writes the obstacles, the nearest first. The span is valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Obstacle> obstacles);

        /// <summary>Reads the results of the batch.</summary>
        /// <returns>False if the batch could not store all hits.</returns>
        private bool TryTakeHits(SensorQueries queries, out int found)
        {
            var spheres = queries.Spheres;
            found = 0;
            for (var hit = 0; hit < spheres.MaxHits; hit++)
            {
                var collider = spheres.HitOf(query, hit).collider;
                if (collider is null) return true;
                if (found == queries.Obstacles.Length) queries.Grow();
                Take(collider, queries.Obstacles, ref found);
            }
            spheres.KeepMore();
            return false;
        }

        private int Overlap(SensorQueries queries)
        {
            int count;
            var radius = FiniteReach;
            // A full array may lack hits, so the query is repeated with a larger one.
            while ((count = Physics.OverlapSphereNonAlloc(Node.Position, radius, queries.Near, layers, QueryTriggerInteraction.Ignore)) == queries.Near.Length)
                queries.Grow();
            var found = 0;
            for (var i = 0; i < count; i++) Take(queries.Near[i], queries.Obstacles, ref found);
            return found;
        }

        private void Take(Collider collider, Obstacle[] obstacles, ref int found)
        {
            // Users' code may have disabled or destroyed the collider after the batch began. It then has no closest point.
            if (collider.IsGone() || Node.Owns(collider)) return;
            var centre = Node.Position;
            var obstacle = new Obstacle(collider, collider.PointClosestTo(centre) - centre);
            var index = found++;
            for (; index > 0 && IsBefore(obstacle, obstacles[index - 1]); index--) obstacles[index] = obstacles[index - 1];
            obstacles[index] = obstacle;
        }

        private static bool IsBefore(in Obstacle a, in Obstacle b) => ColliderExtensions.IsBefore(a.Collider, a.Vector, b.Collider, b.Vector);

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, reach);
    }
}
