using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>An obstacle that an <see cref="ObstacleSensor{TData}"/> measures.</summary>
    public readonly struct Obstacle
    {
        /// <summary>Creates a value.</summary>
        internal Obstacle(Collider collider, Vector3 vector)
        {
            Collider = collider;
            Vector = vector;
        }

        /// <summary>The collider.</summary>
        public Collider Collider { get; }

        /// <summary>The body that the collider belongs to; null for static colliders.</summary>
        public Rigidbody Body => Collider.attachedRigidbody;

        /// <summary>Vector from the node's centre to the collider's closest point, in metres; zero if the centre is inside the collider.</summary>
        public Vector3 Vector { get; }

        /// <summary>Length of <see cref="Vector"/> in metres.</summary>
        public float Distance => Vector.magnitude;
    }
}
