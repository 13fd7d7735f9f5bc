using System;

namespace UnityEngine
{
    public enum SimulationMode
    {
        FixedUpdate = 0,
        Update = 1,
        Script = 2,
    }

    public enum QueryTriggerInteraction
    {
        UseGlobal = 0,
        Ignore = 1,
        Collide = 2,
    }

    public class Physics
    {
        public const int IgnoreRaycastLayer = 1 << 2;
        public const int DefaultRaycastLayers = ~IgnoreRaycastLayer;
        public const int AllLayers = ~0;

        static Physics() => ResetState();

        public static Vector3 gravity { get; set; }
        public static bool queriesHitTriggers { get; set; }
        public static SimulationMode simulationMode { get; set; }

        internal static void ResetState()
        {
            gravity = new Vector3(0f, -9.81f, 0f);
            queriesHitTriggers = true;
            simulationMode = SimulationMode.FixedUpdate;
        }

        public static void Simulate(float step)
        {
            if (simulationMode != SimulationMode.Script)
            {
                Debug.LogError("Physics.Simulate(...) was called but simulation mode is not set to Script. Ignoring.");
                return;
            }
            if (step < 0f) throw new ArgumentOutOfRangeException(nameof(step), step, "A step is 0 s or longer.");
            PhysicsWorld.Step(step);
        }

        public static void SyncTransforms() => PhysicsWorld.SyncTransforms();

        public static void IgnoreCollision(Collider collider1, Collider collider2) => IgnoreCollision(collider1, collider2, true);
        public static void IgnoreCollision(Collider collider1, Collider collider2, bool ignore) => PhysicsWorld.Ignored.Set(collider1, collider2, ignore);
        public static bool GetIgnoreCollision(Collider collider1, Collider collider2) => PhysicsWorld.Ignored.Has(collider1, collider2);
        public static void IgnoreLayerCollision(int layer1, int layer2) => IgnoreLayerCollision(layer1, layer2, true);
        public static void IgnoreLayerCollision(int layer1, int layer2, bool ignore) => PhysicsWorld.Ignored.SetLayers(layer1, layer2, ignore);
        public static bool GetIgnoreLayerCollision(int layer1, int layer2) => PhysicsWorld.Ignored.HasLayers(layer1, layer2);

        // ---- Rays -----------------------------------------------------------------------------------------------------

        public static bool Raycast(Vector3 origin, Vector3 direction, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Raycast(origin, direction, out _, maxDistance, layerMask, queryTriggerInteraction);

        public static bool Raycast(Vector3 origin, Vector3 direction, out RaycastHit hitInfo, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Raycast(origin, direction, out hitInfo, maxDistance, layerMask, queryTriggerInteraction);

        public static bool Raycast(Ray ray, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Raycast(ray.origin, ray.direction, out _, maxDistance, layerMask, queryTriggerInteraction);

        public static bool Raycast(Ray ray, out RaycastHit hitInfo, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Raycast(ray.origin, ray.direction, out hitInfo, maxDistance, layerMask, queryTriggerInteraction);

        public static bool Linecast(Vector3 start, Vector3 end, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Raycast(start, end - start, out _, (end - start).magnitude, layerMask, queryTriggerInteraction);

        public static bool Linecast(Vector3 start, Vector3 end, out RaycastHit hitInfo, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Raycast(start, end - start, out hitInfo, (end - start).magnitude, layerMask, queryTriggerInteraction);

        /// In no particular order, as in Unity; what does not fit is left out.
        public static int RaycastNonAlloc(Vector3 origin, Vector3 direction, RaycastHit[] results, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.RaycastAll(origin, direction, results, maxDistance, layerMask, queryTriggerInteraction);

        public static int RaycastNonAlloc(Ray ray, RaycastHit[] results, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.RaycastAll(ray.origin, ray.direction, results, maxDistance, layerMask, queryTriggerInteraction);

        // ---- Spheres and points ---------------------------------------------------------------------------------------

        /// In no particular order, as in Unity; what does not fit is left out.
        public static int OverlapSphereNonAlloc(Vector3 position, float radius, Collider[] results, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(position, radius, results, layerMask, queryTriggerInteraction);

        public static Collider[] OverlapSphere(Vector3 position, float radius, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal)
        {
            var results = new Collider[Queries.Count(position, radius, layerMask, queryTriggerInteraction)];
            Queries.Overlaps(position, radius, results, layerMask, queryTriggerInteraction);
            return results;
        }

        public static bool CheckSphere(Vector3 position, float radius, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Count(position, radius, layerMask, queryTriggerInteraction) > 0;

        public static Vector3 ClosestPoint(Vector3 point, Collider collider, Vector3 position, Quaternion rotation) =>
            collider.ShapeAt(position, rotation).ClosestPoint(point);
    }
}
