using System;
using Unity.Collections;
using Unity.Jobs;

namespace UnityEngine
{
    public struct QueryParameters
    {
        public int layerMask;
        public bool hitMultipleFaces;
        public QueryTriggerInteraction hitTriggers;
        public bool hitBackfaces;

        public QueryParameters(int layerMask = Physics.DefaultRaycastLayers, bool hitMultipleFaces = false,
            QueryTriggerInteraction hitTriggers = QueryTriggerInteraction.UseGlobal, bool hitBackfaces = false)
        {
            this.layerMask = layerMask;
            this.hitMultipleFaces = hitMultipleFaces;
            this.hitTriggers = hitTriggers;
            this.hitBackfaces = hitBackfaces;
        }

        public static QueryParameters Default => new QueryParameters(Physics.DefaultRaycastLayers);
    }

    public struct ColliderHit
    {
        public Collider collider { get; internal set; }
    }

    /// A ray of a batch. A batch with one hit per ray runs on all physics threads; a batch with more hits runs on the calling thread.
    public struct RaycastCommand
    {
        static RaycastHit[] found = Array.Empty<RaycastHit>();

        public QueryParameters queryParameters;

        public RaycastCommand(Vector3 from, Vector3 direction, QueryParameters queryParameters, float distance = float.MaxValue)
        {
            this.from = from;
            this.direction = direction;
            this.queryParameters = queryParameters;
            this.distance = distance;
        }

        public Vector3 from { get; set; }
        public Vector3 direction { get; set; }
        public float distance { get; set; }

        public static JobHandle ScheduleBatch(NativeArray<RaycastCommand> commands, NativeArray<RaycastHit> results, int minCommandsPerJob, int maxHits,
            JobHandle dependsOn = new JobHandle())
        {
            QueryJobs.Check(commands, results, maxHits);
            foreach (var command in commands.AsSpan())
            {
                // Unity passes the direction to PhysX as it is, which requires a unit vector.
                if (Mathf.Abs(command.direction.sqrMagnitude - 1f) > 1e-3f)
                    throw new ArgumentException("A ray's direction must have length 1, not " + command.direction.magnitude + ".", nameof(commands));
            }
            Headless.QueryLog.Batches++;
            return QueryJobs.Schedule(commands, results, maxHits);
        }

        internal static void Run(NativeArray<RaycastCommand> commands, NativeArray<RaycastHit> results, int maxHits)
        {
            var all = commands.AsSpan();
            if (maxHits == 1)
            {
                Queries.Raycast(all, results.AsSpan());
                return;
            }
            if (found.Length < maxHits) found = new RaycastHit[maxHits];
            for (var index = 0; index < all.Length; index++)
            {
                var count = Math.Min(maxHits, Queries.RaycastAll(all[index], found));
                var hits = results.AsSpan().Slice(index * maxHits, maxHits);
                new Span<RaycastHit>(found, 0, count).CopyTo(hits);
                // A hit without a collider marks the end of a ray's hits. Results after it are not written.
                if (count < maxHits) hits[count] = default;
            }
        }
    }

    /// A sphere of a batch. A started batch runs on other physics threads until its handle or another call to physics waits for the results.
    public struct OverlapSphereCommand
    {
        public QueryParameters queryParameters;

        public OverlapSphereCommand(Vector3 point, float radius, QueryParameters queryParameters)
        {
            this.point = point;
            this.radius = radius;
            this.queryParameters = queryParameters;
        }

        public Vector3 point { get; set; }
        public float radius { get; set; }

        public static JobHandle ScheduleBatch(NativeArray<OverlapSphereCommand> commands, NativeArray<ColliderHit> results, int minCommandsPerJob,
            int maxHits, JobHandle dependsOn = new JobHandle())
        {
            QueryJobs.Check(commands, results, maxHits);
            Headless.QueryLog.Batches++;
            return QueryJobs.Schedule(commands, results, maxHits);
        }
    }
}
