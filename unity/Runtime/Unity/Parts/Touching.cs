using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>What messages about touching colliders leave open.</summary>
    internal static class Touching
    {
        /// <summary>Whether a collider takes no part any more: Unity reports no exit when it is destroyed or disabled while it touches.</summary>
        internal static bool IsGone(this Collider collider) =>
            collider == null || !collider.enabled || !collider.gameObject.activeInHierarchy;

        /// <summary>
        /// Whether a vector comes before another: the shorter one, of equally long ones by x, z, y. Unity gives what it finds in no defined
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
