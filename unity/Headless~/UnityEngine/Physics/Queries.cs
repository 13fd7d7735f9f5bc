namespace UnityEngine
{
    /// Questions about the world at the poses that physics knows. Nothing here allocates but the array results.
    static class Queries
    {
        static bool Passes(Collider collider, int layerMask, QueryTriggerInteraction triggers)
        {
            if ((layerMask & (1 << collider.owner.layer)) == 0) return false;
            return !collider.isTrigger || triggers == QueryTriggerInteraction.Collide
                || triggers == QueryTriggerInteraction.UseGlobal && Physics.queriesHitTriggers;
        }

        /// Puts colliders that touch the sphere into the array as far as it goes; returns how many there are, or the array's length if that is less.
        public static int Overlaps(Vector3 center, float radius, Collider[] results, int layerMask, QueryTriggerInteraction triggers)
        {
            var grid = PhysicsWorld.Grid;
            int touching = grid.InSphere(center, radius), count = 0;
            for (var index = 0; index < touching && count < results.Length; index++)
            {
                var collider = grid.Found(index);
                if (Passes(collider, layerMask, triggers)) results[count++] = collider;
            }
            return count;
        }

        public static int Count(Vector3 center, float radius, int layerMask, QueryTriggerInteraction triggers)
        {
            var grid = PhysicsWorld.Grid;
            int touching = grid.InSphere(center, radius), count = 0;
            for (var index = 0; index < touching; index++)
                if (Passes(grid.Found(index), layerMask, triggers)) count++;
            return count;
        }

        public static bool Hits(Collider collider, Vector3 origin, Vector3 unit, float maxDistance, out RaycastHit hit)
        {
            hit = default;
            if (!collider.World.Raycast(origin, unit, maxDistance, out var distance, out var normal)) return false;
            hit.collider = collider;
            hit.distance = distance;
            hit.point = origin + unit * distance;
            hit.normal = normal;
            return true;
        }

        public static bool Raycast(Vector3 origin, Vector3 direction, out RaycastHit nearest, float maxDistance, int layerMask,
            QueryTriggerInteraction triggers)
        {
            Headless.QueryLog.Rays++;
            nearest = default;
            var unit = direction.normalized;
            if (unit.sqrMagnitude == 0f) return false;
            var grid = PhysicsWorld.Grid;
            var candidates = grid.AlongRay(origin, unit, maxDistance);
            for (var index = 0; index < candidates; index++)
                if (Passes(grid.Found(index), layerMask, triggers) && Hits(grid.Found(index), origin, unit, maxDistance, out var hit)
                    && (nearest.collider is null || hit.distance < nearest.distance))
                    nearest = hit;
            return !(nearest.collider is null);
        }

        public static int RaycastAll(Vector3 origin, Vector3 direction, RaycastHit[] results, float maxDistance, int layerMask,
            QueryTriggerInteraction triggers)
        {
            Headless.QueryLog.Rays++;
            var unit = direction.normalized;
            if (unit.sqrMagnitude == 0f) return 0;
            var grid = PhysicsWorld.Grid;
            var candidates = grid.AlongRay(origin, unit, maxDistance);
            var count = 0;
            for (var index = 0; index < candidates && count < results.Length; index++)
                if (Passes(grid.Found(index), layerMask, triggers) && Hits(grid.Found(index), origin, unit, maxDistance, out var hit)) results[count++] = hit;
            return count;
        }
    }
}
