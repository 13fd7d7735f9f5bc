using System;
using Unity.Collections;
using Unity.Jobs;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Physics queries that Unity runs together on its worker threads. Meanwhile, the calling thread can do other work that does not use physics. Allocates
    /// only while its capacity grows.
    /// </summary>
    internal abstract class QueryBatch<TCommand, THit> : IDisposable
        where TCommand : struct
        where THit : struct
    {
        private const int MinPerJob = 32;

        /// <summary>
        /// Maximum number of hits stored per query, which limits the memory of a batch. Queries with more hits are repeated without the batch.
        /// </summary>
        private const int MaxKeptHits = 64;

        private NativeArray<TCommand> commands;
        private NativeArray<THit> hits;
        private int nextMaxHits;
        private JobHandle running;

        /// <param name="maxHits">Number of hits stored per query at first, 1 or more. With 1, only the nearest hit is stored.</param>
        protected QueryBatch(int maxHits) => MaxHits = nextMaxHits = maxHits;

        internal int MaxHits { get; private set; }

        internal int Count { get; private set; }

        internal void Clear() => Count = 0;

        /// <returns>The number of the query in the batch.</returns>
        internal int Add(in TCommand command)
        {
            if (Count == commands.Length) Grow(ref commands, Count, Math.Max(64, 2 * Count));
            commands[Count] = command;
            return Count++;
        }

        internal void Run()
        {
            Begin();
            Finish();
        }

        /// <summary>Starts the queries. The batch must not change before <see cref="Finish"/>.</summary>
        internal void Begin()
        {
            if (Count == 0) return;
            MaxHits = nextMaxHits;
            if (Count * MaxHits > hits.Length) Grow(ref hits, 0, commands.Length * MaxHits);
            running = Schedule(commands.GetSubArray(0, Count), hits.GetSubArray(0, Count * MaxHits), MinPerJob, MaxHits);
        }

        /// <summary>Waits for the results. A second call does nothing.</summary>
        internal void Finish() => running.Complete();

        /// <summary>
        /// Returns a hit of a query. <paramref name="index"/> is less than <see cref="MaxHits"/>. Hits are not sorted, and a hit without a collider marks
        /// the end.
        /// </summary>
        internal THit HitOf(int query, int index) => hits[query * MaxHits + index];

        /// <summary>Increases the number of hits stored per query in later batches.</summary>
        internal void KeepMore() => nextMaxHits = Math.Min(MaxKeptHits, 2 * MaxHits);

        /// <inheritdoc/>
        public void Dispose()
        {
            Finish();
            Count = 0;
            Free(ref commands);
            Free(ref hits);
        }

        protected abstract JobHandle Schedule(NativeArray<TCommand> commands, NativeArray<THit> hits, int minPerJob, int maxHits);

        /// <summary>Enlarges an array, and copies its first <paramref name="used"/> items.</summary>
        private static void Grow<T>(ref NativeArray<T> array, int used, int length) where T : struct
        {
            var longer = new NativeArray<T>(length, Allocator.Persistent);
            for (var i = 0; i < used; i++) longer[i] = array[i];
            Free(ref array);
            array = longer;
        }

        private static void Free<T>(ref NativeArray<T> array) where T : struct
        {
            if (array.IsCreated) array.Dispose();
            array = default;
        }
    }

    internal sealed class RayBatch : QueryBatch<RaycastCommand, RaycastHit>
    {
        internal RayBatch(int maxHits) : base(maxHits)
        {
        }

        protected override JobHandle Schedule(NativeArray<RaycastCommand> commands, NativeArray<RaycastHit> hits, int minPerJob, int maxHits) =>
            RaycastCommand.ScheduleBatch(commands, hits, minPerJob, maxHits);
    }

    internal sealed class SphereBatch : QueryBatch<OverlapSphereCommand, ColliderHit>
    {
        internal SphereBatch(int maxHits) : base(maxHits)
        {
        }

        protected override JobHandle Schedule(NativeArray<OverlapSphereCommand> commands, NativeArray<ColliderHit> hits, int minPerJob, int maxHits) =>
            OverlapSphereCommand.ScheduleBatch(commands, hits, minPerJob, maxHits);
    }
}
