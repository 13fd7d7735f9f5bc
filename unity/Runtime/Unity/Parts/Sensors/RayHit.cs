using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The hit of a ray of a <see cref="RayFanSensor{TData}"/>.</summary>
    public readonly struct RayHit
    {
        /// <summary>Creates a value.</summary>
        internal RayHit(Vector3 direction, float distance, Collider collider)
        {
            Direction = direction;
            Distance = distance;
            Collider = collider;
        }

        /// <summary>Direction of the ray in the world, of length 1.</summary>
        public Vector3 Direction { get; }

        /// <summary>Distance of the hit in metres, or the sensor's range without a hit.</summary>
        public float Distance { get; }

        /// <summary>The collider, or null without a hit.</summary>
        public Collider Collider { get; }
    }
}
