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
        /// Returns whether <paramref name="a"/> is sorted before <paramref name="b"/>: by length, then by x, z and y. Hits need a defined order, because
        /// Unity returns them in an undefined one, and a sum of floats depends on the order.
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
