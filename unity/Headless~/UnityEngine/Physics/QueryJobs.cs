using System;
using System.Collections.Generic;
using Unity.Collections;
using Unity.Jobs;

namespace UnityEngine
{
    /// The batches of queries that were scheduled but not started, in the order in which they were scheduled.
    static class QueryJobs
    {
        struct Job
        {
            internal int Number;
            internal int MaxHits;
            // Whether the batch contains rays; otherwise it contains spheres.
            internal NativeArray<RaycastCommand> Rays;
            internal NativeArray<RaycastHit> RayHits;
            internal NativeArray<OverlapSphereCommand> Spheres;
            internal NativeArray<ColliderHit> SphereHits;
        }

        static readonly List<Job> Waiting = new List<Job>();
        static int scheduled;

        /// The last batch of spheres that was started.
        static int running;

        internal static void Check<TCommand, THit>(NativeArray<TCommand> commands, NativeArray<THit> results, int maxHits)
            where TCommand : struct where THit : struct
        {
            // AsSpan throws an exception if the array is disposed.
            if (results.AsSpan().Length < commands.AsSpan().Length * maxHits)
                throw new ArgumentException("The results are shorter than commands * maxHits.", nameof(results));
        }

        internal static JobHandle Schedule(NativeArray<RaycastCommand> rays, NativeArray<RaycastHit> hits, int maxHits)
        {
            Waiting.Add(new Job { Number = ++scheduled, MaxHits = maxHits, Rays = rays, RayHits = hits });
            return new JobHandle(scheduled);
        }

        internal static JobHandle Schedule(NativeArray<OverlapSphereCommand> spheres, NativeArray<ColliderHit> hits, int maxHits)
        {
            Waiting.Add(new Job { Number = ++scheduled, MaxHits = maxHits, Spheres = spheres, SphereHits = hits });
            return new JobHandle(scheduled);
        }

        internal static int Count => Waiting.Count;

        /// Starts all batches. Batches of rays are complete when it returns.
        internal static void Start()
        {
            for (var i = 0; i < Waiting.Count; i++)
            {
                var job = Waiting[i];
                if (job.Rays.IsCreated)
                {
                    RaycastCommand.Run(job.Rays, job.RayHits, job.MaxHits);
                    continue;
                }
                OverlapBatch.Begin(job.Spheres.AsSpan(), job.SphereHits, job.MaxHits);
                running = job.Number;
            }
            Waiting.Clear();
        }

        internal static bool IsRunning(int number) => OverlapBatch.IsRunning && number == running;

        /// Whether a batch that has not ended uses the memory of an array.
        internal static bool Uses(object memory)
        {
            foreach (var job in Waiting)
                if (job.Rays.Memory == memory || job.RayHits.Memory == memory || job.Spheres.Memory == memory || job.SphereHits.Memory == memory) return true;
            return OverlapBatch.Uses(memory);
        }

        internal static void ResetState() => Waiting.Clear();
    }
}
