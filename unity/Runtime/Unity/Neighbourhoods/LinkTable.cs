using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>
    /// All directed links of the scene, with their reference counts, and the changes that are not sent to the JVM yet.
    /// A link exists while at least one rule or script references it. No allocation once its capacity is reached.
    ///
    /// In a large scene cache misses dominate. So the two links of a pair of nodes lie side by side, since most are referenced and released
    /// together, and values are collected and then written to all links in one pass.
    /// </summary>
    internal sealed class LinkTable
    {
        private const int None = -1;

        private struct Change
        {
            internal LinkHandle Handle;
            internal float Length;
            internal float Attenuation;
        }

        private LinkPair[] pairs = new LinkPair[64];
        private int[] buckets = new int[64];
        // Pairs with a changed direction.
        private readonly GrowingArray<int> dirty = new GrowingArray<int>();
        // Values that are not written to their links yet, in the order of their arrival.
        private readonly GrowingArray<Change> changes = new GrowingArray<Change>();
        private int firstFree = None;
        private int used;

        internal LinkTable()
        {
            Array.Fill(buckets, None);
        }

        /// <summary>All pairs, including unused ones, for views. The array is not a copy, and is valid until a link is added.</summary>
        internal Span<LinkPair> Pairs => new Span<LinkPair>(pairs, 0, used);

        /// <summary>Number of pairs that fit in the table's memory.</summary>
        internal int PairCapacity => pairs.Length;

        /// <summary>Number of links.</summary>
        internal int Count { get; private set; }

        /// <summary>Increases whenever links are removed with their nodes. While it is unchanged, no handle became stale.</summary>
        internal int RemovalCount { get; private set; }

        /// <summary>Replaces a list's content with all links and the values of the last <see cref="ApplyChanges"/>.</summary>
        internal void CopyTo(List<LinkRecord> target)
        {
            target.Clear();
            for (var i = 0; i < used; i++)
            {
                ref var pair = ref pairs[i];
                if (pair.Up.References > 0) target.Add(Record(pair.Low, pair.High, pair.Up));
                if (pair.Down.References > 0) target.Add(Record(pair.High, pair.Low, pair.Down));
            }
        }

        /// <summary>Whether a link exists.</summary>
        internal bool Contains(int from, int to)
        {
            var index = Find(from, to);
            return index != None && DirectionOf(index, from, to).References > 0;
        }

        /// <summary>Adds a reference to one or both links of a pair, which are created if needed, and returns the handle for <see cref="Release"/>.</summary>
        internal LinkHandle AddReference(int from, int to, bool bothWays, float length, float attenuation)
        {
            var index = Find(from, to);
            if (index == None) index = Insert(from, to);
            var handle = new LinkHandle(index, pairs[index].Generation, bothWays || from <= to, bothWays || from > to);
            ref var pair = ref pairs[index];
            if (handle.Up) AddReference(index, ref pair, ref pair.Up);
            if (handle.Down) AddReference(index, ref pair, ref pair.Down);
            Update(handle, length, attenuation);
            return handle;
        }

        /// <summary>Whether a handle is not stale: links of nodes that left are removed.</summary>
        internal bool IsAlive(in LinkHandle handle) => IsAlive(pairs[handle.Pair], handle);

        /// <summary>Sets new values of the handle's links.</summary>
        internal void Update(in LinkHandle handle, float length, float attenuation)
        {
            ref var change = ref changes.Add();
            change.Handle = handle;
            change.Length = length;
            change.Attenuation = attenuation;
        }

        /// <summary>Applies the values that were set.</summary>
        internal void ApplyChanges()
        {
            var all = changes.Items;
            for (var i = 0; i < changes.Count; i++)
            {
                ref var change = ref all[i];
                ref var handle = ref change.Handle;
                ref var pair = ref pairs[handle.Pair];
                if (!IsAlive(pair, handle)) continue;
                if (handle.Up) SetValues(handle.Pair, ref pair, ref pair.Up, change.Length, change.Attenuation);
                if (handle.Down) SetValues(handle.Pair, ref pair, ref pair.Down, change.Length, change.Attenuation);
            }
            changes.Clear();
        }

        /// <summary>Releases one reference. Does nothing if the link is already removed.</summary>
        internal void Release(in LinkHandle handle)
        {
            ref var pair = ref pairs[handle.Pair];
            if (!IsAlive(pair, handle)) return;
            if (handle.Up) Release(handle.Pair, ref pair, ref pair.Up);
            if (handle.Down) Release(handle.Pair, ref pair, ref pair.Down);
        }

        /// <summary>Adds the scripts' reference to a link, at most once.</summary>
        internal void AddScriptReference(int from, int to, float length, float attenuation)
        {
            var index = Find(from, to);
            if (index == None || !DirectionOf(index, from, to).ByScript)
            {
                // Not in one expression: adding a reference may replace the array.
                index = AddReference(from, to, false, length, attenuation).Pair;
                DirectionOf(index, from, to).ByScript = true;
                return;
            }
            Update(new LinkHandle(index, pairs[index].Generation, from <= to, from > to), length, attenuation);
        }

        /// <summary>Releases the scripts' reference.</summary>
        /// <returns>False if no script added the link.</returns>
        internal bool ReleaseForScripts(int from, int to)
        {
            var index = Find(from, to);
            if (index == None || !DirectionOf(index, from, to).ByScript) return false;
            ref var direction = ref DirectionOf(index, from, to);
            direction.ByScript = false;
            Release(index, ref pairs[index], ref direction);
            return true;
        }

        /// <summary>Removes all links of nodes that left (<paramref name="isGone"/> by id); the JVM removes its own with the node.</summary>
        internal void DropLinksOf(PagedArray<bool> isGone)
        {
            RemovalCount++;
            for (var index = 0; index < used; index++)
            {
                ref var pair = ref pairs[index];
                if (pair.NextInBucket < None) continue;
                if (!isGone[pair.Low] && !isGone[pair.High]) continue;
                Drop(ref pair.Up);
                Drop(ref pair.Down);
                pair.Generation++;
                if (!pair.IsDirty) Free(index);
            }
        }

        /// <summary>
        /// Writes to the request what changed since the last call. Links of nodes that were not sent to the JVM (<paramref name="isKnown"/>
        /// by id) are written by a later call.
        /// </summary>
        internal void Flush(StepRequest request, PagedArray<bool> isKnown)
        {
            ApplyChanges();
            var waiting = 0;
            for (var i = 0; i < dirty.Count; i++)
            {
                var index = dirty.Items[i];
                ref var pair = ref pairs[index];
                if (pair.IsReferenced && !(isKnown[pair.Low] && isKnown[pair.High]))
                {
                    dirty.Items[waiting++] = index;
                    continue;
                }
                if (pair.Up.Dirty) Flush(request, pair.Low, pair.High, ref pair.Up);
                if (pair.Down.Dirty) Flush(request, pair.High, pair.Low, ref pair.Down);
                if (!pair.IsReferenced) Free(index);
            }
            dirty.Truncate(waiting);
        }

        private static void Flush(StepRequest request, int from, int to, ref LinkDirection direction)
        {
            direction.Dirty = false;
            if (direction.References > 0) request.SetLink(Record(from, to, direction));
            else if (direction.Sent) request.RemoveLink(new LinkEnds { From = from, To = to });
            direction.Sent = direction.References > 0;
        }

        internal static LinkRecord Record(int from, int to, in LinkDirection direction) =>
            new LinkRecord { From = from, To = to, Length = direction.Length, Attenuation = direction.Attenuation };

        private static int Hash(int low, int high)
        {
            var mixed = unchecked((uint)low * 0x9E3779B1u ^ (uint)high * 0x85EBCA77u);
            return unchecked((int)(mixed ^ mixed >> 15));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool IsAlive(in LinkPair pair, in LinkHandle handle) =>
            pair.Generation == handle.Generation && (handle.Up ? pair.Up : pair.Down).References > 0;

        private ref LinkDirection DirectionOf(int index, int from, int to)
        {
            ref var pair = ref pairs[index];
            if (from <= to) return ref pair.Up;
            return ref pair.Down;
        }

        private void AddReference(int index, ref LinkPair pair, ref LinkDirection direction)
        {
            if (direction.References++ > 0) return;
            Count++;
            Touch(index, ref pair, ref direction);
        }

        private void Release(int index, ref LinkPair pair, ref LinkDirection direction)
        {
            if (--direction.References > 0) return;
            Count--;
            Touch(index, ref pair, ref direction);
        }

        private void Drop(ref LinkDirection direction)
        {
            if (direction.References > 0) Count--;
            direction.References = 0;
            direction.Sent = false;
            direction.ByScript = false;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void SetValues(int index, ref LinkPair pair, ref LinkDirection direction, float length, float attenuation)
        {
            if (direction.Length == length && direction.Attenuation == attenuation) return;
            direction.Length = length;
            direction.Attenuation = attenuation;
            Touch(index, ref pair, ref direction);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void Touch(int index, ref LinkPair pair, ref LinkDirection direction)
        {
            if (!pair.IsDirty) dirty.Add(index);
            direction.Dirty = true;
        }

        private int Find(int from, int to)
        {
            var low = Math.Min(from, to);
            var high = Math.Max(from, to);
            var all = pairs;
            for (var index = buckets[Hash(low, high) & buckets.Length - 1]; index != None;)
            {
                ref var pair = ref all[index];
                if (pair.Low == low && pair.High == high) return index;
                index = pair.NextInBucket;
            }
            return None;
        }

        private int Insert(int from, int to)
        {
            int index;
            if (firstFree != None)
            {
                index = firstFree;
                firstFree = FreeLink(pairs[index].NextInBucket);
            }
            else
            {
                if (used == pairs.Length) Grow();
                index = used++;
            }
            ref var pair = ref pairs[index];
            pair.Low = Math.Min(from, to);
            pair.High = Math.Max(from, to);
            pair.Up = default;
            pair.Down = default;
            Chain(index);
            return index;
        }

        /// <summary>The next free pair is stored as a number below -1, which distinguishes free pairs from chained ones.</summary>
        private static int FreeLink(int next) => -3 - next;

        private void Free(int index)
        {
            ref var pair = ref pairs[index];
            ref var head = ref buckets[Hash(pair.Low, pair.High) & buckets.Length - 1];
            if (head == index)
            {
                head = pair.NextInBucket;
            }
            else
            {
                var previous = head;
                while (pairs[previous].NextInBucket != index) previous = pairs[previous].NextInBucket;
                pairs[previous].NextInBucket = pair.NextInBucket;
            }
            pair.Generation++;
            pair.NextInBucket = FreeLink(firstFree);
            firstFree = index;
        }

        private void Chain(int index)
        {
            ref var pair = ref pairs[index];
            ref var head = ref buckets[Hash(pair.Low, pair.High) & buckets.Length - 1];
            pair.NextInBucket = head;
            head = index;
        }

        private void Grow()
        {
            Array.Resize(ref pairs, pairs.Length * 2);
            buckets = new int[pairs.Length];
            Array.Fill(buckets, None);
            for (var index = 0; index < used; index++)
            {
                if (pairs[index].NextInBucket >= None) Chain(index);
            }
        }
    }
}
