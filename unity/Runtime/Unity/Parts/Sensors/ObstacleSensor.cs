using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Perceives the colliders within reach of the node's centre, other nodes' bodies included, its own and triggers not, with the closest point of
    /// each. The closest point is exact for boxes, spheres, capsules and convex meshes; for other colliders it is that of their bounds.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ObstacleSensor<TData> : Sensor<TData>
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Metres from the node's centre.")]
        private float reach = 1;

        [SerializeField]
        [Tooltip("Layers to perceive.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        // The number of the query in the batch.
        private int query;

        /// <summary>Metres from the node's centre, 0 or greater.</summary>
        public float Reach
        {
            get => reach;
            set => reach = value;
        }

        /// <summary>Layers to perceive.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            var body = Node.Body;
            var centre = Node.Position;
            var queries = Node.Simulation.Queries;
            var count = queries.Sensors.Has(this) ? TakeHits(queries) : Overlap(centre, queries);
            var found = 0;
            for (var i = 0; i < count; i++)
            {
                var collider = queries.Near[i];
                if (collider.transform.IsChildOf(body)) continue;
                Insert(new Obstacle(collider, collider.PointClosestTo(centre) - centre), queries.Obstacles, found++);
            }
            Write(ref data, new Span<Obstacle>(queries.Obstacles, 0, found));
        }

        internal sealed override void Enqueue()
        {
            var parameters = new QueryParameters(layers, false, QueryTriggerInteraction.Ignore);
            query = Node.Simulation.Queries.Spheres.Add(new OverlapSphereCommand(Node.Position, reach, parameters));
        }

        /// <summary>Writes what there is, the nearest first. The obstacles are valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Obstacle> obstacles);

        /// <summary>The colliders that the batch found, or all of them if it could not keep all.</summary>
        private int TakeHits(SensorQueries queries)
        {
            var spheres = queries.Spheres;
            for (var count = 0; count < spheres.MaxHits; count++)
            {
                var collider = spheres.HitOf(query, count).collider;
                if (collider == null) return count;
                if (count == queries.Near.Length) queries.Grow();
                queries.Near[count] = collider;
            }
            spheres.KeepMore();
            return Overlap(Node.Position, queries);
        }

        private int Overlap(Vector3 centre, SensorQueries queries)
        {
            for (; ; )
            {
                var count = Physics.OverlapSphereNonAlloc(centre, reach, queries.Near, layers, QueryTriggerInteraction.Ignore);
                if (count < queries.Near.Length) return count;
                // A full array may have left some out.
                queries.Grow();
            }
        }

        private static void Insert(in Obstacle obstacle, Obstacle[] obstacles, int count)
        {
            var place = count;
            for (; place > 0 && Touching.IsBefore(obstacle.Vector, obstacles[place - 1].Vector); place--) obstacles[place] = obstacles[place - 1];
            obstacles[place] = obstacle;
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, reach);
    }
}
