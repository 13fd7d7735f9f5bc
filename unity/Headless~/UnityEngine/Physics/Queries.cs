using System;

namespace UnityEngine
{
    /// Queries of the world. They use the poses that were last synchronised to physics. In steady state, only results that are new arrays allocate.
    static unsafe class Queries
    {
        static Physx.Hit[] hits = new Physx.Hit[64];
        static int[] shapes = new int[64];
        static Physx.RayLine[] lines = new Physx.RayLine[64];
        static Physx.Filter[] filters = new Physx.Filter[64];

        /// PhysX's world, after synchronising moved transforms.
        static IntPtr World
        {
            get
            {
                PhysicsWorld.Flush();
                return PhysicsWorld.Handle;
            }
        }

        internal static Physx.Filter Filter(int layerMask, QueryTriggerInteraction triggers) =>
            new Physx.Filter { Layers = layerMask, Triggers = HitsTriggers(triggers) ? 1 : 0 };

        static Physx.Filter Filter(in QueryParameters query)
        {
            var filter = Filter(query.layerMask, query.hitTriggers);
            if (query.hitBackfaces) filter.Faces |= Physx.Faces.Back;
            return filter;
        }

        static bool HitsTriggers(QueryTriggerInteraction triggers) =>
            triggers == QueryTriggerInteraction.Collide || triggers == QueryTriggerInteraction.UseGlobal && Physics.queriesHitTriggers;

        static bool IsFinite(Vector3 value)
        {
            var sum = value.x + value.y + value.z;
            return sum - sum == 0f;
        }

        /// Creates the ray of a query. Returns false if the ray has no direction or length, or if a number is not finite.
        static bool Line(Vector3 origin, Vector3 direction, float maxDistance, out Physx.RayLine line) =>
            UnitLine(origin, Unit(direction), maxDistance, out line);

        /// As in Unity, queries accept directions that are too short for `Vector3.normalized`.
        static Vector3 Unit(Vector3 direction)
        {
            var length = direction.magnitude;
            return length > 0f ? direction / length : Vector3.zero;
        }

        /// Like `Line`, for a sweep. As in Unity, a sweep of length 0 finds the shapes that it overlaps.
        static bool SweepLine(Vector3 origin, Vector3 direction, float maxDistance, out Physx.RayLine line)
        {
            var hasLength = Line(origin, direction, maxDistance == 0f ? 1f : maxDistance, out line);
            line.Distance = maxDistance;
            return hasLength;
        }

        /// Like `Line`, for a direction of length 1.
        static bool UnitLine(Vector3 origin, Vector3 direction, float maxDistance, out Physx.RayLine line)
        {
            line = new Physx.RayLine { Origin = origin, Direction = direction, Distance = maxDistance };
            return line.Direction.sqrMagnitude > 0f && maxDistance > 0f && IsFinite(origin) && IsFinite(direction);
        }

        // ---- Rays -----------------------------------------------------------------------------------------------------

        public static bool Raycast(Vector3 origin, Vector3 direction, out RaycastHit nearest, float maxDistance, int layerMask,
            QueryTriggerInteraction triggers)
        {
            Headless.QueryLog.Rays++;
            nearest = default;
            if (!Line(origin, direction, maxDistance, out var line)) return false;
            var filter = Filter(layerMask, triggers);
            Physx.Hit hit;
            Physx.physics_raycast(World, &line, &filter, 1, &hit);
            if (hit.Shape == Physx.None) return false;
            nearest = new RaycastHit(hit);
            return true;
        }

        /// Finds the nearest hit of each ray, on all threads of physics.
        public static void Raycast(Span<RaycastCommand> commands, Span<RaycastHit> nearest)
        {
            Headless.QueryLog.Rays += commands.Length;
            var count = commands.Length;
            Reserve(ref lines, count);
            Reserve(ref filters, count);
            Reserve(ref hits, count);
            for (var index = 0; index < count; index++)
            {
                ref var command = ref commands[index];
                var asks = UnitLine(command.from, command.direction, command.distance, out lines[index]);
                filters[index] = asks ? Filter(command.queryParameters) : default;
                if (!asks) lines[index] = new Physx.RayLine { Direction = Vector3.right, Distance = 1f };
            }
            fixed (Physx.RayLine* rays = lines)
            fixed (Physx.Filter* filter = filters)
            fixed (Physx.Hit* found = hits) Physx.physics_raycast(World, rays, filter, count, found);
            for (var index = 0; index < count; index++) nearest[index] = hits[index].Shape == Physx.None ? default : new RaycastHit(hits[index]);
        }

        /// Fills the array up to its length, and returns the number of results.
        public static int RaycastAll(Vector3 origin, Vector3 direction, RaycastHit[] results, float maxDistance, int layerMask,
            QueryTriggerInteraction triggers) => UnitRaycastAll(origin, Unit(direction), results, maxDistance, Filter(layerMask, triggers));

        public static int RaycastAll(in RaycastCommand command, RaycastHit[] results)
        {
            var filter = Filter(command.queryParameters);
            if (command.queryParameters.hitMultipleFaces) filter.Faces |= Physx.Faces.All;
            return UnitRaycastAll(command.from, command.direction, results, command.distance, filter);
        }

        static int UnitRaycastAll(Vector3 origin, Vector3 direction, RaycastHit[] results, float maxDistance, Physx.Filter filter)
        {
            Headless.QueryLog.Rays++;
            if (!UnitLine(origin, direction, maxDistance, out var line)) return 0;
            Reserve(ref hits, results.Length);
            int count;
            fixed (Physx.Hit* found = hits) count = Physx.physics_raycast_all(World, &line, &filter, found, results.Length);
            return Take(results, count);
        }

        public static bool RaycastOne(Collider collider, Ray ray, out RaycastHit hitInfo, float maxDistance)
        {
            hitInfo = default;
            if (!Line(ray.origin, ray.direction, maxDistance, out var line)) return false;
            Physx.Hit hit;
            if (Physx.physics_raycast_shape(World, collider.Handle, &line, &hit) == 0) return false;
            hitInfo = new RaycastHit(hit);
            return true;
        }

        // ---- Sweeps ---------------------------------------------------------------------------------------------------

        public static bool Sweep(Physx.Geometry geometry, Physx.Pose pose, Vector3 direction, out RaycastHit nearest, float maxDistance, int layerMask,
            QueryTriggerInteraction triggers)
        {
            nearest = default;
            if (!SweepLine(pose.Position, direction, maxDistance, out var line)) return false;
            var filter = Filter(layerMask, triggers);
            Physx.Hit hit;
            if (Physx.physics_sweep(World, &geometry, &pose, &line.Direction, line.Distance, &filter, &hit, 0) == 0) return false;
            nearest = new RaycastHit(hit);
            return true;
        }

        /// Includes shapes that the geometry overlaps at its start.
        public static int SweepAll(Physx.Geometry geometry, Physx.Pose pose, Vector3 direction, RaycastHit[] results, float maxDistance, int layerMask,
            QueryTriggerInteraction triggers)
        {
            if (results.Length == 0 || !SweepLine(pose.Position, direction, maxDistance, out var line)) return 0;
            Reserve(ref hits, results.Length);
            var filter = Filter(layerMask, triggers);
            int count;
            fixed (Physx.Hit* found = hits)
                count = Physx.physics_sweep(World, &geometry, &pose, &line.Direction, line.Distance, &filter, found, results.Length);
            return Take(results, count);
        }

        public static bool Sweep(Rigidbody body, Vector3 direction, out RaycastHit nearest, float maxDistance, QueryTriggerInteraction triggers)
        {
            nearest = default;
            if (!body.Registered || !SweepLine(body.position, direction, maxDistance, out var line)) return false;
            Physx.Hit hit;
            if (Physx.physics_sweep_actor(World, body.Handle, &line.Direction, line.Distance, HitsTriggers(triggers) ? 1 : 0, &hit, 0) == 0) return false;
            nearest = new RaycastHit(hit);
            return true;
        }

        public static RaycastHit[] SweepAll(Rigidbody body, Vector3 direction, float maxDistance, QueryTriggerInteraction triggers)
        {
            if (!body.Registered || !SweepLine(body.position, direction, maxDistance, out var line)) return new RaycastHit[0];
            int count;
            do
            {
                fixed (Physx.Hit* found = hits)
                    count = Physx.physics_sweep_actor(World, body.Handle, &line.Direction, line.Distance, HitsTriggers(triggers) ? 1 : 0, found, hits.Length);
            }
            while (Grow(ref hits, count));
            return Taken(count);
        }

        /// Returns all results of a query that fills an array up to its length.
        public static RaycastHit[] All(Func<RaycastHit[], int> query)
        {
            var results = new RaycastHit[16];
            int count;
            while ((count = query(results)) == results.Length) results = new RaycastHit[2 * count];
            Array.Resize(ref results, count);
            return results;
        }

        // ---- Overlaps -------------------------------------------------------------------------------------------------

        /// Fills the array with colliders that touch the geometry, and returns their number.
        public static int Overlaps(Physx.Geometry geometry, Physx.Pose pose, Collider[] results, int layerMask, QueryTriggerInteraction triggers)
        {
            if (results.Length == 0) return 0;
            Reserve(ref shapes, results.Length);
            var count = Overlapping(geometry, pose, layerMask, triggers, results.Length);
            for (var index = 0; index < count; index++) results[index] = PhysicsWorld.ColliderOf(shapes[index]);
            return count;
        }

        public static Collider[] Overlaps(Physx.Geometry geometry, Physx.Pose pose, int layerMask, QueryTriggerInteraction triggers)
        {
            int count;
            do count = Overlapping(geometry, pose, layerMask, triggers, shapes.Length);
            while (Grow(ref shapes, count));
            var results = new Collider[count];
            for (var index = 0; index < count; index++) results[index] = PhysicsWorld.ColliderOf(shapes[index]);
            return results;
        }

        public static bool Check(Physx.Geometry geometry, Physx.Pose pose, int layerMask, QueryTriggerInteraction triggers) =>
            Overlapping(geometry, pose, layerMask, triggers, 1) > 0;

        static int Overlapping(Physx.Geometry geometry, Physx.Pose pose, int layerMask, QueryTriggerInteraction triggers, int capacity)
        {
            if (!IsFinite(pose.Position) || !IsFinite(geometry.Half) || !IsFinite(new Vector3(geometry.Radius, 0f, 0f))) return 0;
            var filter = Filter(layerMask, triggers);
            fixed (int* found = shapes) return Physx.physics_overlap(World, &geometry, &pose, &filter, found, capacity);
        }

        // ---- Distances ------------------------------------------------------------------------------------------------

        public static Vector3 ClosestPoint(Collider collider, Vector3 point)
        {
            if (!CanBeNear(collider)) return point;
            Vector3 closest;
            Physx.physics_closest_point(World, collider.Handle, null, &point, &closest);
            return closest;
        }

        public static Vector3 ClosestPoint(Collider collider, Vector3 point, Vector3 position, Quaternion rotation)
        {
            if (!CanBeNear(collider) || collider.Handle == Physx.None) return point;
            var at = collider.GeometryAt(position, rotation);
            Vector3 closest;
            Physx.physics_closest_point(World, collider.Handle, &at, &point, &closest);
            return closest;
        }

        static bool CanBeNear(Collider collider)
        {
            if (collider.HasClosestPoint) return true;
            Debug.LogError("Physics.ClosestPoint can only be used with a BoxCollider, SphereCollider, CapsuleCollider and a convex MeshCollider.", collider);
            return false;
        }

        public static bool Penetration(Collider a, Vector3 positionA, Quaternion rotationA, Collider b, Vector3 positionB, Quaternion rotationB,
            out Vector3 direction, out float distance)
        {
            direction = Vector3.zero;
            distance = 0f;
            if (a.Handle == Physx.None || b.Handle == Physx.None) return false;
            Physx.Pose atA = a.GeometryAt(positionA, rotationA), atB = b.GeometryAt(positionB, rotationB);
            Vector3 separation;
            float depth;
            if (Physx.physics_penetration(World, a.Handle, &atA, b.Handle, &atB, &separation, &depth) == 0) return false;
            direction = separation;
            distance = depth;
            return true;
        }

        // ---- Buffers --------------------------------------------------------------------------------------------------

        static void Reserve<T>(ref T[] buffer, int length)
        {
            if (buffer.Length < length) buffer = new T[length];
        }

        /// Enlarges a full buffer, which may have been too small.
        static bool Grow<T>(ref T[] buffer, int count)
        {
            if (count < buffer.Length) return false;
            buffer = new T[2 * buffer.Length];
            return true;
        }

        static int Take(RaycastHit[] results, int count)
        {
            for (var index = 0; index < count; index++) results[index] = new RaycastHit(hits[index]);
            return count;
        }

        static RaycastHit[] Taken(int count)
        {
            var results = new RaycastHit[count];
            Take(results, count);
            return results;
        }
    }
}
