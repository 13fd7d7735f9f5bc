using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A collider near a node, as an <see cref="ObstacleSensor{TData}"/> perceives it.</summary>
    public readonly struct Obstacle
    {
        /// <summary>Makes one.</summary>
        internal Obstacle(Collider collider, Vector3 vector)
        {
            Collider = collider;
            Vector = vector;
        }

        /// <summary>The collider.</summary>
        public Collider Collider { get; }

        /// <summary>The body that the collider belongs to; null for what stands still for ever.</summary>
        public Rigidbody Body => Collider.attachedRigidbody;

        /// <summary>From the node's centre to the collider's closest point, in metres; zero when the centre is inside the collider.</summary>
        public Vector3 Vector { get; }

        /// <summary>Length of <see cref="Vector"/> in metres.</summary>
        public float Distance => Vector.magnitude;
    }
}
