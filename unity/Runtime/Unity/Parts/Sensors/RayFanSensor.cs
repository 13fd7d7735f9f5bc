using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Perceives distances by rays from the node's centre, spread in the plane of its right and forward axes like a fan around forward. The
    /// node's own colliders and triggers are passed through.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class RayFanSensor<TData> : Sensor<TData>
    {
        private const float Whole = 360;

        /// <summary>Metres behind a point of the node's own collider where a ray goes on.</summary>
        private const float Gap = 1e-3f;

        [SerializeField]
        [Range(1, 360)]
        [Tooltip("How many rays.")]
        private int rays = 8;

        [SerializeField]
        [Range(0, Whole)]
        [Tooltip("Degrees from the first ray to the last; 360: all around, the first ray straight ahead.")]
        private float angle = Whole;

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres that a ray reaches.")]
        private float range = 5;

        [SerializeField]
        [Tooltip("Layers that stop a ray.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        private RayHit[] hits = Array.Empty<RayHit>();
        private Vector3[] directions = Array.Empty<Vector3>();
        private float angleOfDirections;

        /// <summary>How many rays, 1 or more.</summary>
        public int Rays
        {
            get => rays;
            set => rays = value;
        }

        /// <summary>Degrees from the first ray to the last, 0..360; 360: all around, the first ray straight ahead.</summary>
        public float Angle
        {
            get => angle;
            set => angle = value;
        }

        /// <summary>Metres that a ray reaches, 0 or greater.</summary>
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

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            // By the hits: when scripts are compiled during play, Unity keeps the directions alone.
            if (hits.Length != rays || angleOfDirections != angle) Spread();
            var centre = Node.Position;
            var turn = Node.Body.rotation;
            for (var i = 0; i < directions.Length; i++) hits[i] = Cast(centre, turn * directions[i]);
            Write(ref data, hits);
        }

        /// <summary>Writes what the rays met, from left to right, or clockwise seen from above. The hits are valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<RayHit> hits);

        private void Spread()
        {
            hits = new RayHit[Math.Max(rays, 0)];
            directions = new Vector3[hits.Length];
            angleOfDirections = angle;
            for (var i = 0; i < directions.Length; i++) directions[i] = Quaternion.AngleAxis(AngleOf(i), Vector3.up) * Vector3.forward;
        }

        private float AngleOf(int ray)
        {
            if (angle >= Whole) return Whole * ray / rays;
            return rays == 1 ? 0 : angle * ((float)ray / (rays - 1) - 0.5f);
        }

        private RayHit Cast(Vector3 centre, Vector3 direction)
        {
            var passed = 0f;
            while (Physics.Raycast(centre + passed * direction, direction, out var hit, range - passed, layers, QueryTriggerInteraction.Ignore))
            {
                if (!hit.collider.transform.IsChildOf(Node.Body)) return new RayHit(direction, passed + hit.distance, hit.collider);
                passed += hit.distance + Gap;
                if (passed >= range) break;
            }
            return new RayHit(direction, range, null);
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
