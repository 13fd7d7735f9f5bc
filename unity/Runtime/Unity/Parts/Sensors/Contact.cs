using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A collider that touches a node, as a <see cref="ContactSensor{TData}"/> perceives it.</summary>
    public readonly struct Contact
    {
        /// <summary>Makes one.</summary>
        internal Contact(Collider collider, Vector3 point, Vector3 normal, Vector3 impulse)
        {
            Collider = collider;
            Point = point;
            Normal = normal;
            Impulse = impulse;
        }

        /// <summary>The collider that touches the node.</summary>
        public Collider Collider { get; }

        /// <summary>The body that the collider belongs to; null for what stands still for ever.</summary>
        public Rigidbody Body => Collider.attachedRigidbody;

        /// <summary>Middle of the points of contact, in the world.</summary>
        public Vector3 Point { get; }

        /// <summary>Out of the other collider, towards the node, of length 1.</summary>
        public Vector3 Normal { get; }

        /// <summary>What the contact did to the node since its last round, in newton seconds; it points away from the other collider.</summary>
        public Vector3 Impulse { get; }
    }
}
