using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>What one ray of a <see cref="RayFanSensor{TData}"/> met.</summary>
    public readonly struct RayHit
    {
        /// <summary>Makes one.</summary>
        internal RayHit(Vector3 direction, float distance, Collider collider)
        {
            Direction = direction;
            Distance = distance;
            Collider = collider;
        }

        /// <summary>Direction of the ray in the world, of length 1.</summary>
        public Vector3 Direction { get; }

        /// <summary>Metres to what the ray met; the sensor's range when it met nothing.</summary>
        public float Distance { get; }

        /// <summary>What the ray met; null when it met nothing.</summary>
        public Collider Collider { get; }
    }
}
