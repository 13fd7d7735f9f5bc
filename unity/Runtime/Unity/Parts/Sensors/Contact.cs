using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A contact that a <see cref="ContactSensor{TData}"/> detects.</summary>
    public readonly struct Contact
    {
        /// <summary>Creates a value.</summary>
        internal Contact(Collider own, Collider collider, Rigidbody body, Vector3 point, Vector3 normal, Vector3 impulse)
        {
            Own = own;
            Collider = collider;
            Body = body;
            Point = point;
            Normal = normal;
            Impulse = impulse;
        }

        /// <summary>The collider that touches the node.</summary>
        public Collider Collider { get; }

        /// <summary>The node's collider.</summary>
        internal Collider Own { get; }

        /// <summary>The body that the collider belongs to; null for static colliders.</summary>
        public Rigidbody Body { get; }

        /// <summary>Mean contact point in world space.</summary>
        public Vector3 Point { get; }

        /// <summary>Unit vector from the other collider towards the node.</summary>
        public Vector3 Normal { get; }

        /// <summary>Impulse on the node since its last round, in newton seconds. It points away from the other collider.</summary>
        public Vector3 Impulse { get; }

        /// <summary>Whether the touch ended without a message.</summary>
        internal bool HasEnded => Own.IsGone() || Collider.HasLeft(Body);

        internal bool IsOf(Collider own, Collider collider) => ReferenceEquals(Own, own) && ReferenceEquals(Collider, collider);

        internal Contact WithImpulse(Vector3 impulse) => new Contact(Own, Collider, Body, Point, Normal, impulse);
    }
}
