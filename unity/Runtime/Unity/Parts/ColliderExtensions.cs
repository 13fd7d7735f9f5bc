using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Helpers for colliders in contact.</summary>
    internal static class ColliderExtensions
    {
        /// <summary>Whether the use of bounds was reported, once for all colliders.</summary>
        private static bool hasReportedBounds;

        /// <summary>Returns whether a collider is destroyed or disabled: Unity reports no exit for it.</summary>
        internal static bool IsGone(this Collider collider) =>
            collider == null || !collider.enabled || !collider.gameObject.activeInHierarchy;

        /// <summary>
        /// Returns the point of a collider that is closest to a point. Unity computes it for boxes, spheres, capsules and convex meshes, and logs an error for
        /// each call with another collider. For these, it is the closest point of their bounds.
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
        /// Whether a vector comes before another: the shorter one first, equally long ones by x, z, y. Unity returns hits in an undefined order, but sums of
        /// floats are only reproducible in a fixed order.
        /// </summary>
        internal static bool IsBefore(Vector3 a, Vector3 b)
        {
            var difference = a.sqrMagnitude - b.sqrMagnitude;
            if (difference != 0) return difference < 0;
            if (a.x != b.x) return a.x < b.x;
            return a.z != b.z ? a.z < b.z : a.y < b.y;
        }
    }
}
