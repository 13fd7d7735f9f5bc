using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>What messages about touching colliders leave open.</summary>
    internal static class Touching
    {
        /// <summary>Whether the use of bounds was reported already; once for all colliders.</summary>
        private static bool saidBounds;

        /// <summary>Whether a collider takes no part any more: Unity reports no exit when it is destroyed or disabled while it touches.</summary>
        internal static bool IsGone(this Collider collider) =>
            collider == null || !collider.enabled || !collider.gameObject.activeInHierarchy;

        /// <summary>
        /// The point of a collider that is closest to another one. Unity computes it for boxes, spheres, capsules and convex meshes, and logs an error for each
        /// call with another collider: for these it is the closest point of their bounds.
        /// </summary>
        internal static Vector3 PointClosestTo(this Collider collider, Vector3 point)
        {
            if (collider is BoxCollider || collider is SphereCollider || collider is CapsuleCollider || collider is MeshCollider mesh && mesh.convex)
                return collider.ClosestPoint(point);
            if (!saidBounds)
            {
                saidBounds = true;
                Debug.LogWarning("the closest point of '" + collider.name + "', whose collider is no box, sphere, capsule or convex mesh, is that of its "
                    + "bounds: make its mesh convex, or keep it on a layer that sensors do not look at", collider);
            }
            return collider.bounds.ClosestPoint(point);
        }

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics() => saidBounds = false;

        /// <summary>
        /// Whether a vector comes before another: the shorter one first, equally long ones by x, z, y. Unity returns hits in no defined
        /// order; sums of floats repeat only in a defined one.
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
