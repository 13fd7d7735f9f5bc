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

        static bool isFrictionImproved;

        /// Whether friction does not exceed the normal force times the coefficient. By default, it can be twice as strong, for example for boxes.
        public static bool improvedPatchFriction
        {
            get => isFrictionImproved;
            set
            {
                isFrictionImproved = value;
                Physx.physics_improve_friction(PhysicsWorld.Handle, value ? 1 : 0);
            }
        }

        internal static void ResetState()
        {
            gravity = new Vector3(0f, -9.81f, 0f);
            queriesHitTriggers = true;
            simulationMode = SimulationMode.FixedUpdate;
            isFrictionImproved = false;
        }

        public static void Simulate(float step)
        {
            if (simulationMode != SimulationMode.Script)
            {
                Debug.LogWarning("Physics.Simulate(...) was called but simulation mode is not set to Script. Ignoring.");
                return;
            }
            if (!(step >= 0f)) throw new ArgumentOutOfRangeException(nameof(step), step, "A step must be 0 s or longer.");
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

        /// Results are unordered, as in Unity. Those that do not fit are skipped.
        public static int RaycastNonAlloc(Vector3 origin, Vector3 direction, RaycastHit[] results, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.RaycastAll(origin, direction, results, maxDistance, layerMask, queryTriggerInteraction);

        public static int RaycastNonAlloc(Ray ray, RaycastHit[] results, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.RaycastAll(ray.origin, ray.direction, results, maxDistance, layerMask, queryTriggerInteraction);

        public static RaycastHit[] RaycastAll(Vector3 origin, Vector3 direction, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.All(results => Queries.RaycastAll(origin, direction, results, maxDistance, layerMask, queryTriggerInteraction));

        public static RaycastHit[] RaycastAll(Ray ray, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            RaycastAll(ray.origin, ray.direction, maxDistance, layerMask, queryTriggerInteraction);

        // ---- Shapes ---------------------------------------------------------------------------------------------------

        static Physx.Geometry Ball(float radius) => new Physx.Geometry { Kind = Physx.Kind.Sphere, Radius = Mathf.Abs(radius) };
        static Physx.Geometry Block(Vector3 half) =>
            new Physx.Geometry { Kind = Physx.Kind.Box, Half = new Vector3(Mathf.Abs(half.x), Mathf.Abs(half.y), Mathf.Abs(half.z)) };

        static Physx.Pose At(Vector3 position) => new Physx.Pose(position, Quaternion.identity);
        static Physx.Pose At(Vector3 position, Quaternion rotation) => new Physx.Pose(position, rotation.normalized);

        /// Returns the capsule whose caps have the given centres.
        static Physx.Geometry CapsuleGeometry(Vector3 from, Vector3 to, float radius, out Physx.Pose pose)
        {
            var length = (to - from).magnitude;
            pose = new Physx.Pose((from + to) * 0.5f, length > 0f ? Quaternion.FromToRotation(Vector3.right, to - from) : Quaternion.identity);
            if (length == 0f) return Ball(radius);
            return new Physx.Geometry { Kind = Physx.Kind.Capsule, Radius = Mathf.Abs(radius), Half = new Vector3(length * 0.5f, 0f, 0f) };
        }

        // ---- Sweeps ---------------------------------------------------------------------------------------------------

        /// Ignores shapes that the sphere overlaps at its start.
        public static bool SphereCast(Vector3 origin, float radius, Vector3 direction, out RaycastHit hitInfo, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Sweep(Ball(radius), At(origin), direction, out hitInfo, maxDistance, layerMask, queryTriggerInteraction);

        public static bool SphereCast(Ray ray, float radius, float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            SphereCast(ray.origin, radius, ray.direction, out _, maxDistance, layerMask, queryTriggerInteraction);

        public static bool SphereCast(Ray ray, float radius, out RaycastHit hitInfo, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            SphereCast(ray.origin, radius, ray.direction, out hitInfo, maxDistance, layerMask, queryTriggerInteraction);

        public static int SphereCastNonAlloc(Vector3 origin, float radius, Vector3 direction, RaycastHit[] results, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.SweepAll(Ball(radius), At(origin), direction, results, maxDistance, layerMask, queryTriggerInteraction);

        public static RaycastHit[] SphereCastAll(Vector3 origin, float radius, Vector3 direction, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.All(results => SphereCastNonAlloc(origin, radius, direction, results, maxDistance, layerMask, queryTriggerInteraction));

        public static bool CapsuleCast(Vector3 point1, Vector3 point2, float radius, Vector3 direction, float maxDistance = Mathf.Infinity,
            int layerMask = DefaultRaycastLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            CapsuleCast(point1, point2, radius, direction, out _, maxDistance, layerMask, queryTriggerInteraction);

        public static bool CapsuleCast(Vector3 point1, Vector3 point2, float radius, Vector3 direction, out RaycastHit hitInfo,
            float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Sweep(CapsuleGeometry(point1, point2, radius, out var pose), pose, direction, out hitInfo, maxDistance, layerMask, queryTriggerInteraction);

        public static bool BoxCast(Vector3 center, Vector3 halfExtents, Vector3 direction, Quaternion orientation = default,
            float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            BoxCast(center, halfExtents, direction, out _, orientation, maxDistance, layerMask, queryTriggerInteraction);

        public static bool BoxCast(Vector3 center, Vector3 halfExtents, Vector3 direction, out RaycastHit hitInfo, Quaternion orientation = default,
            float maxDistance = Mathf.Infinity, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Sweep(Block(halfExtents), At(center, orientation), direction, out hitInfo, maxDistance, layerMask, queryTriggerInteraction);

        // ---- Overlaps -------------------------------------------------------------------------------------------------

        /// Results are unordered, as in Unity. Those that do not fit are skipped.
        public static int OverlapSphereNonAlloc(Vector3 position, float radius, Collider[] results, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(Ball(radius), At(position), results, layerMask, queryTriggerInteraction);

        public static Collider[] OverlapSphere(Vector3 position, float radius, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(Ball(radius), At(position), layerMask, queryTriggerInteraction);

        public static bool CheckSphere(Vector3 position, float radius, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Check(Ball(radius), At(position), layerMask, queryTriggerInteraction);

        public static int OverlapBoxNonAlloc(Vector3 center, Vector3 halfExtents, Collider[] results, Quaternion orientation = default,
            int mask = AllLayers, QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(Block(halfExtents), At(center, orientation), results, mask, queryTriggerInteraction);

        public static Collider[] OverlapBox(Vector3 center, Vector3 halfExtents, Quaternion orientation = default, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(Block(halfExtents), At(center, orientation), layerMask, queryTriggerInteraction);

        public static bool CheckBox(Vector3 center, Vector3 halfExtents, Quaternion orientation = default, int layermask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Check(Block(halfExtents), At(center, orientation), layermask, queryTriggerInteraction);

        public static int OverlapCapsuleNonAlloc(Vector3 point0, Vector3 point1, float radius, Collider[] results, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(CapsuleGeometry(point0, point1, radius, out var pose), pose, results, layerMask, queryTriggerInteraction);

        public static Collider[] OverlapCapsule(Vector3 point0, Vector3 point1, float radius, int layerMask = AllLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Overlaps(CapsuleGeometry(point0, point1, radius, out var pose), pose, layerMask, queryTriggerInteraction);

        public static bool CheckCapsule(Vector3 start, Vector3 end, float radius, int layerMask = DefaultRaycastLayers,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Check(CapsuleGeometry(start, end, radius, out var pose), pose, layerMask, queryTriggerInteraction);

        // ---- Distances ------------------------------------------------------------------------------------------------

        public static Vector3 ClosestPoint(Vector3 point, Collider collider, Vector3 position, Quaternion rotation) =>
            Queries.ClosestPoint(collider, point, position, rotation);

        /// Computes the shortest translation that separates the first collider from the second at these poses.
        public static bool ComputePenetration(Collider colliderA, Vector3 positionA, Quaternion rotationA, Collider colliderB, Vector3 positionB,
            Quaternion rotationB, out Vector3 direction, out float distance) =>
            Queries.Penetration(colliderA, positionA, rotationA, colliderB, positionB, rotationB, out direction, out distance);
    }
}
