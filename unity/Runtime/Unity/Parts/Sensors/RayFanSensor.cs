using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Measures distances along rays that start at the node's centre. The rays form a fan around the node's forward axis, in the plane of its right and
    /// forward axes. They ignore triggers and the node's own colliders.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class RayFanSensor<TData> : Sensor<TData>
    {
        private const float Whole = 360;

        [SerializeField]
        [Range(1, 360)]
        [Tooltip("Number of rays.")]
        private int rays = 8;

        [SerializeField]
        [Range(0, Whole)]
        [Tooltip("Degrees between the first and the last ray. 360: all around, starting forward.")]
        private float angle = Whole;

        [SerializeField]
        [Min(0)]
        [Tooltip("Length of the rays in metres.")]
        private float range = 5;

        [SerializeField]
        [Tooltip("Layers that stop a ray.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        private RayHit[] hits = Array.Empty<RayHit>();
        private Vector3[] directions = Array.Empty<Vector3>();
        private Vector3[] worldDirections = Array.Empty<Vector3>();
        private float angleOfDirections;

        // The index of this sensor's first ray in the batch, and the length and layers of its rays.
        private int query;
        private float batchedRange;
        private LayerMask batchedLayers;

        /// <summary>Number of rays, 1 or more.</summary>
        public int Rays
        {
            get => rays;
            set => rays = value;
        }

        /// <summary>Degrees between the first and the last ray, 0..360; 360: all around, starting forward.</summary>
        public float Angle
        {
            get => angle;
            set => angle = value;
        }

        /// <summary>Length of the rays in metres, 0 or greater.</summary>
        public float Range
        {
            get => range;
            set => range = value;
        }

        /// <summary>Layers that stop a ray.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <summary>
        /// Whether the directions no longer match the settings. The number of hits is compared, because only the directions survive when scripts are
        /// compiled during play.
        /// </summary>
        private bool MustUpdateDirections => hits.Length != rays || !angleOfDirections.Equals(angle);

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) => Write(ref data, hits);

        internal sealed override void Prepare(TickContext tick)
        {
            if (rays < 1) throw new InvalidOperationException("its number of rays is " + rays + ": set it to 1 or greater");
            CheckNotNegative("angle", angle);
            CheckNotNegative("range", range);
            var queries = tick.Queries;
            // The batch is not used if another sensor changed the fan after the batch began.
            var isBatched = queries.Sensors.Has(this) && !MustUpdateDirections && batchedRange == range && batchedLayers == layers;
            if (!isBatched) UpdateDirections();
            var centre = Node.Position;
            for (var i = 0; i < worldDirections.Length; i++)
            {
                var nearest = isBatched ? queries.Rays.HitOf(query + i, 0) : default;
                // Users' code may have disabled or destroyed the collider after the batch began.
                if (!isBatched || nearest.collider is Collider collider && collider.IsGone())
                    Physics.Raycast(centre, worldDirections[i], out nearest, range, layers, QueryTriggerInteraction.Ignore);
                hits[i] = FirstForeign(queries, centre, worldDirections[i], nearest);
            }
        }

        internal sealed override void Enqueue(TickContext tick)
        {
            if (rays < 1 || !(angle >= 0 && range >= 0))
            {
                batchedRange = float.NaN;
                return;
            }
            UpdateDirections();
            var fans = tick.Queries.Rays;
            query = fans.Count;
            (batchedRange, batchedLayers) = (range, layers);
            var parameters = new QueryParameters(layers, false, QueryTriggerInteraction.Ignore);
            // A command requires a unit vector, but rotation changes the length slightly.
            for (var i = 0; i < worldDirections.Length; i++) fans.Add(new RaycastCommand(Node.Position, worldDirections[i].normalized, parameters, range));
        }

        /// <summary>Writes the hits from left to right, clockwise seen from above. The span is valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<RayHit> hits);

        /// <summary>Rotates the rays with the node.</summary>
        private void UpdateDirections()
        {
            if (MustUpdateDirections) ComputeLocalDirections();
            var turn = Node.Body.rotation;
            for (var i = 0; i < worldDirections.Length; i++) worldDirections[i] = turn * directions[i];
        }

        private void ComputeLocalDirections()
        {
            hits = new RayHit[rays];
            worldDirections = new Vector3[hits.Length];
            directions = new Vector3[hits.Length];
            angleOfDirections = angle;
            for (var i = 0; i < directions.Length; i++) directions[i] = Quaternion.AngleAxis(AngleOf(i), Vector3.up) * Vector3.forward;
        }

        private float AngleOf(int ray)
        {
            if (angle >= Whole) return Whole * ray / rays;
            return rays == 1 ? 0 : angle * ((float)ray / (rays - 1) - 0.5f);
        }

        /// <summary>Returns the first hit that is not the node's own collider. If the nearest hit is the node's own, all hits are compared.</summary>
        private RayHit FirstForeign(SensorQueries queries, Vector3 centre, Vector3 direction, in RaycastHit nearest)
        {
            var first = new RayHit(direction, range, null);
            if (nearest.collider == null) return first;
            if (!Node.Owns(nearest.collider)) return new RayHit(direction, nearest.distance, nearest.collider);
            int count;
            // A full array may lack hits, so the query is repeated with a larger one.
            while ((count = Physics.RaycastNonAlloc(centre, direction, queries.Hits, range, layers, QueryTriggerInteraction.Ignore)) == queries.Hits.Length)
                queries.Hits = new RaycastHit[2 * queries.Hits.Length];
            for (var i = 0; i < count; i++)
            {
                ref var hit = ref queries.Hits[i];
                if (hit.distance > first.Distance || Node.Owns(hit.collider)) continue;
                if (first.Collider is null || ColliderExtensions.IsBefore(hit.collider, hit.distance * direction, first.Collider, first.Distance * direction))
                    first = new RayHit(direction, hit.distance, hit.collider);
            }
            return first;
        }

        private void OnDrawGizmosSelected()
        {
            for (var i = 0; i < rays; i++)
            {
                Gizmos.DrawRay(transform.position, transform.rotation * Quaternion.AngleAxis(AngleOf(i), Vector3.up) * Vector3.forward * range);
            }
        }
    }
}
