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

    /// The queries of a batch run one after another.
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
            if (results.Length < commands.Length * maxHits) throw new ArgumentException("The results are shorter than commands * maxHits.", nameof(results));
            Headless.QueryLog.Batches++;
            if (found.Length < maxHits) found = new RaycastHit[maxHits];
            var all = commands.AsSpan();
            for (var index = 0; index < all.Length; index++)
            {
                ref var command = ref all[index];
                int mask = command.queryParameters.layerMask, count;
                var triggers = command.queryParameters.hitTriggers;
                if (maxHits == 1) count = Queries.Raycast(command.from, command.direction, out found[0], command.distance, mask, triggers) ? 1 : 0;
                else count = Math.Min(maxHits, Queries.RaycastAll(command.from, command.direction, found, command.distance, mask, triggers));
                var hits = results.AsSpan().Slice(index * maxHits, maxHits);
                new Span<RaycastHit>(found, 0, count).CopyTo(hits);
                // The first hit without a collider is the end; those behind it are what they were.
                if (count < maxHits) hits[count] = default;
            }
            return default;
        }
    }

    /// The queries of a batch run one after another.
    public struct OverlapSphereCommand
    {
        static Collider[] found = Array.Empty<Collider>();

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
            if (results.Length < commands.Length * maxHits) throw new ArgumentException("The results are shorter than commands * maxHits.", nameof(results));
            Headless.QueryLog.Batches++;
            if (found.Length < maxHits) found = new Collider[maxHits];
            var all = commands.AsSpan();
            for (var index = 0; index < all.Length; index++)
            {
                ref var command = ref all[index];
                var query = command.queryParameters;
                var count = Math.Min(maxHits, Physics.OverlapSphereNonAlloc(command.point, command.radius, found, query.layerMask, query.hitTriggers));
                var hits = results.AsSpan().Slice(index * maxHits, maxHits);
                for (var place = 0; place < count; place++) hits[place].collider = found[place];
                if (count < maxHits) hits[count] = default;
            }
            Array.Clear(found, 0, found.Length);
            return default;
        }
    }
}
