using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The result of one ray of a <see cref="RayFanSensor{TData}"/>.</summary>
    public readonly struct RayHit
    {
        /// <summary>Creates a value.</summary>
        internal RayHit(Vector3 direction, float distance, Collider collider)
        {
            Direction = direction;
            Distance = distance;
            Collider = collider;
        }

        /// <summary>Direction of the ray in world space, a unit vector.</summary>
        public Vector3 Direction { get; }

        /// <summary>Distance of the hit in metres, or the sensor's range if the ray hit nothing.</summary>
        public float Distance { get; }

        /// <summary>The collider that the ray hit, or null.</summary>
        public Collider Collider { get; }
    }
}
