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

        /// Brings those that touch the sphere to the front of the grid's result; returns their number.
        public static int Overlaps(Vector3 center, float radius, int layerMask, QueryTriggerInteraction triggers, int limit = int.MaxValue)
        {
            var grid = PhysicsWorld.Grid;
            var reach = new Vector3(radius, radius, radius);
            int candidates = grid.InBox(center - reach, center + reach), count = 0;
            var found = grid.Found;
            for (var index = 0; index < candidates && count < limit; index++)
            {
                var collider = found[index];
                if (Passes(collider, layerMask, triggers) && collider.World.TouchesSphere(center, radius)) found[count++] = collider;
            }
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

        public static bool Raycast(Vector3 origin, Vector3 direction, out RaycastHit nearest, float maxDistance, int layerMask, QueryTriggerInteraction triggers)
        {
            nearest = default;
            var unit = direction.normalized;
            if (unit.sqrMagnitude == 0f) return false;
            var candidates = PhysicsWorld.Grid.AlongRay(origin, unit, maxDistance);
            var found = PhysicsWorld.Grid.Found;
            for (var index = 0; index < candidates; index++)
                if (Passes(found[index], layerMask, triggers) && Hits(found[index], origin, unit, maxDistance, out var hit)
                    && (nearest.collider is null || hit.distance < nearest.distance))
                    nearest = hit;
            return !(nearest.collider is null);
        }

        public static int RaycastAll(Vector3 origin, Vector3 direction, RaycastHit[] results, float maxDistance, int layerMask, QueryTriggerInteraction triggers)
        {
            var unit = direction.normalized;
            if (unit.sqrMagnitude == 0f) return 0;
            var candidates = PhysicsWorld.Grid.AlongRay(origin, unit, maxDistance);
            var found = PhysicsWorld.Grid.Found;
            var count = 0;
            for (var index = 0; index < candidates && count < results.Length; index++)
                if (Passes(found[index], layerMask, triggers) && Hits(found[index], origin, unit, maxDistance, out var hit)) results[count++] = hit;
            return count;
        }
    }
}
