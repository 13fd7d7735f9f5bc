using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Counts the obstacles on the straight lines between pairs of nodes. Each line is counted once per tick, even if both nodes request it. The rays of
    /// most lines are cast in batches before the rules are called. Rays of new rules, and rays with more hits than a batch can store, are cast one by one.
    /// </summary>
    internal sealed class SightLines : IDisposable
    {
        /// <summary>Number of obstacles of a line whose ray has not been cast.</summary>
        private const int Unknown = -1;

        /// <summary>Rays per batch. Larger batches would need more memory without being faster.</summary>
        private const int MaxRays = 4096;

        private readonly RayBatch rays = new RayBatch(16);
        private readonly Pair[] requested = new Pair[MaxRays];

        // The number of obstacles on each line, indexed by the line's number in this tick.
        private readonly GrowingArray<int> obstacles = new GrowingArray<int>();

        // A hash table with open addressing. Entries of earlier ticks count as free.
        private Line[] lines = new Line[256];
        private RaycastHit[] hits = new RaycastHit[16];

        internal SightLines(Simulation simulation) => Rules = new BatchedParts(simulation);

        private struct Line
        {
            internal ulong Batch;
            internal int Low;
            internal int High;
            internal int Layers;
            internal int Number;
        }

        private readonly struct Pair
        {
            internal readonly Node From;
            internal readonly Node To;
            internal readonly int Layers;
            internal readonly float Distance;

            /// <summary>
            /// Creates a pair whose ray starts at the node with the lower id, whichever node requests it. The direction matters, because a ray ignores
            /// colliders that contain its origin.
            /// </summary>
            internal Pair(Node a, Node b, int layers, float distance)
            {
                From = a.Id < b.Id ? a : b;
                To = a.Id < b.Id ? b : a;
                Layers = layers;
                Distance = distance;
            }

            internal Vector3 Vector => To.Position - From.Position;

            /// <summary>Direction of the ray. It has length 1 even if both nodes are at the same position.</summary>
            internal Vector3 Direction
            {
                get
                {
                    var direction = Vector.normalized;
                    return direction == Vector3.zero ? Vector3.up : direction;
                }
            }

            internal bool IsForeign(Collider collider) => !From.Owns(collider) && !To.Owns(collider);
        }

        /// <summary>The rules whose lines are cast in batches.</summary>
        internal BatchedParts Rules { get; }

        /// <summary>Begins a tick. Discards the lines of the previous tick, and casts the rays of all rules.</summary>
        internal void Begin()
        {
            obstacles.Clear();
            // Rules are also called for nodes that are not due.
            Rules.Begin(isForDueNodes: false);
            Cast();
        }

        /// <summary>
        /// Adds the line between two nodes to the batch, unless it was already requested in this tick. Call this in <see cref="NodePart.Enqueue"/>.
        /// </summary>
        /// <returns>The line's number in this tick.</returns>
        internal int Request(Node a, Node b, int layers, float distance)
        {
            if (rays.Count == MaxRays) Cast();
            var number = NumberOf(a.Id, b.Id, layers, out var isNew);
            if (!isNew) return number;
            var pair = new Pair(a, b, layers, distance);
            requested[rays.Count] = pair;
            rays.Add(new RaycastCommand(pair.From.Position, pair.Direction, new QueryParameters(layers, false, QueryTriggerInteraction.Ignore), distance));
            return number;
        }

        /// <summary>Returns the number of colliders on a requested line, without the colliders of its two nodes.</summary>
        internal int ObstaclesOf(int line) => obstacles.Items[line];

        /// <summary>
        /// Returns the number of colliders between two nodes for a rule that is not in the batch. The ray is cast now, unless the line was already counted
        /// in this tick. <paramref name="distance"/> is the distance between the nodes.
        /// </summary>
        internal int CountObstacles(Node a, Node b, int layers, float distance)
        {
            var line = NumberOf(a.Id, b.Id, layers, out _);
            if (obstacles.Items[line] == Unknown) obstacles.Items[line] = CastWithoutBatch(new Pair(a, b, layers, distance));
            return obstacles.Items[line];
        }

        /// <inheritdoc/>
        public void Dispose() => rays.Dispose();

        /// <summary>Casts the rays that were requested since the last cast, and stores the obstacles of their lines.</summary>
        private void Cast()
        {
            rays.Run();
            var first = obstacles.Count - rays.Count;
            for (var i = 0; i < rays.Count; i++)
            {
                obstacles.Items[first + i] = Count(i, requested[i]);
                requested[i] = default;
            }
            rays.Clear();
        }

        /// <summary>Counts the obstacles among a ray's hits in the batch. If the batch could not store all hits, casts the ray again.</summary>
        private int Count(int ray, in Pair pair)
        {
            var count = 0;
            for (var hit = 0; hit < rays.MaxHits; hit++)
            {
                var collider = rays.HitOf(ray, hit).collider;
                if (collider is null) return count;
                if (pair.IsForeign(collider)) count++;
            }
            rays.KeepMore();
            return CastWithoutBatch(pair);
        }

        private int CastWithoutBatch(in Pair pair)
        {
            int hitCount;
            // A full array may lack hits, so the query is repeated with a larger one.
            while ((hitCount = Physics.RaycastNonAlloc(
                pair.From.Position, pair.Vector, hits, pair.Distance, pair.Layers, QueryTriggerInteraction.Ignore)) == hits.Length)
            {
                hits = new RaycastHit[2 * hits.Length];
            }
            var count = 0;
            for (var i = 0; i < hitCount; i++)
            {
                if (pair.IsForeign(hits[i].collider)) count++;
            }
            return count;
        }

        /// <summary>Returns the number of the line between two nodes in this tick. A new line has <see cref="Unknown"/> obstacles.</summary>
        private int NumberOf(int a, int b, int layers, out bool isNew)
        {
            if (2 * obstacles.Count >= lines.Length) Grow();
            ref var line = ref Find(Math.Min(a, b), Math.Max(a, b), layers);
            isNew = line.Batch != Rules.Batch;
            if (!isNew) return line.Number;
            line = new Line { Batch = Rules.Batch, Low = Math.Min(a, b), High = Math.Max(a, b), Layers = layers, Number = obstacles.Count };
            obstacles.Add(Unknown);
            return line.Number;
        }

        private ref Line Find(int low, int high, int layers)
        {
            var all = lines;
            var slot = Hash(low, high, layers) & all.Length - 1;
            for (; ; slot = slot + 1 & all.Length - 1)
            {
                ref var line = ref all[slot];
                if (line.Batch != Rules.Batch || line.Low == low && line.High == high && line.Layers == layers) return ref line;
            }
        }

        private static int Hash(int low, int high, int layers)
        {
            var mixed = unchecked((uint)low * 0x9E3779B1u ^ (uint)high * 0x85EBCA77u ^ (uint)layers * 0xC2B2AE3Du);
            return unchecked((int)(mixed ^ mixed >> 15));
        }

        private void Grow()
        {
            var old = lines;
            lines = new Line[2 * old.Length];
            foreach (var line in old)
            {
                if (line.Batch == Rules.Batch) Find(line.Low, line.High, line.Layers) = line;
            }
        }
    }
}
