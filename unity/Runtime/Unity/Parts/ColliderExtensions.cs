using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Helpers for sensors that handle colliders.</summary>
    internal static class ColliderExtensions
    {
        /// <summary>Whether the use of bounds was reported. It is reported for one collider only.</summary>
        private static bool hasReportedBounds;

        /// <summary>Returns whether a collider was destroyed or disabled, in which case Unity sends no exit message for it.</summary>
        internal static bool IsGone(this Collider collider) =>
            collider == null || !collider.enabled || !collider.gameObject.activeInHierarchy;

        /// <summary>
        /// Returns whether a collider is gone or belongs to another body than <paramref name="body"/>. Unity sends no exit message when the body changes, but
        /// another enter message if the colliders still touch.
        /// </summary>
        internal static bool HasLeft(this Collider collider, Rigidbody body) => collider.IsGone() || collider.attachedRigidbody != body;

        /// <summary>
        /// Returns the point of a collider that is closest to <paramref name="point"/>. Unity can compute it for boxes, spheres, capsules and convex meshes
        /// only, and logs an error at each call with another collider. For other colliders, the closest point of their bounds is returned.
        /// </summary>
        internal static Vector3 PointClosestTo(this Collider collider, Vector3 point)
        {
            if (collider is BoxCollider || collider is SphereCollider || collider is CapsuleCollider || collider is MeshCollider mesh && mesh.convex)
                return collider.ClosestPoint(point);
            if (!hasReportedBounds)
            {
                hasReportedBounds = true;
                Debug.LogWarning("the collider of '" + collider.name + "' is not a box, sphere, capsule or convex mesh: its closest point is computed from its "
                    + "bounds. Make its mesh convex, or move it to a layer that sensors ignore", collider);
            }
            return collider.bounds.ClosestPoint(point);
        }

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics() => hasReportedBounds = false;

        /// <summary>
        /// Returns whether collider <paramref name="a"/> is sorted before <paramref name="b"/>: by the offsets of their hits, then by the ids of their nodes,
        /// then by their positions and sizes. Hits need a defined order, because Unity returns them in an undefined one, and a sum of floats depends on the
        /// order.
        /// </summary>
        internal static bool IsBefore(Collider a, Vector3 offsetOfA, Collider b, Vector3 offsetOfB)
        {
            var order = Compare(offsetOfA, offsetOfB);
            if (order == 0) order = NodeId(a).CompareTo(NodeId(b));
            if (order == 0) order = Compare(a.bounds.center, b.bounds.center);
            return (order == 0 ? Compare(a.bounds.size, b.bounds.size) : order) < 0;
        }

        /// <summary>Compares vectors by length, then by x, z and y.</summary>
        private static int Compare(Vector3 a, Vector3 b)
        {
            var order = a.sqrMagnitude.CompareTo(b.sqrMagnitude);
            if (order == 0) order = a.x.CompareTo(b.x);
            if (order == 0) order = a.z.CompareTo(b.z);
            return order == 0 ? a.y.CompareTo(b.y) : order;
        }

        private static int NodeId(Collider collider)
        {
            var node = collider.GetComponentInParent<Node>();
            return node == null ? -1 : node.Id;
        }
    }
}
