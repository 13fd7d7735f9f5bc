using System;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>
    /// All directed links of the scene, each with the number of rules that hold it, and what of them the JVM does not know yet.
    /// A link exists while somebody holds it. No allocation once its capacity is reached.
    /// </summary>
    internal sealed class LinkTable
    {
        private const int None = -1;

        private struct Entry
        {
            internal LinkRecord Link;
            internal int Holders;
            internal int Generation;
            internal int NextInBucket;
            internal bool Sent;
            internal bool Dirty;
            internal bool ByScript;
        }

        private Entry[] entries = new Entry[64];
        private int[] buckets = new int[64];
        private readonly GrowingArray<int> dirty = new GrowingArray<int>();
        private int firstFree = None;

        internal LinkTable()
        {
            Array.Fill(buckets, None);
        }

        /// <summary>Entries ever used; the argument of <see cref="TryGet"/> is below it.</summary>
        internal int Capacity { get; private set; }

        /// <summary>Links that exist.</summary>
        internal int Count { get; private set; }

        /// <summary>A link that exists, by entry; false for a free entry.</summary>
        internal bool TryGet(int entry, out LinkRecord link)
        {
            link = entries[entry].Link;
            return entries[entry].Holders > 0;
        }

        /// <summary>Whether a link exists.</summary>
        internal bool Contains(int from, int to)
        {
            var index = Find(from, to);
            return index != None && entries[index].Holders > 0;
        }

        /// <summary>Holds a link, made if need be, and returns the handle for <see cref="Release"/>.</summary>
        internal LinkHandle Hold(int from, int to, float length, float attenuation)
        {
            var index = Find(from, to);
            if (index == None) index = Insert(from, to);
            ref var entry = ref entries[index];
            if (entry.Holders++ == 0)
            {
                Count++;
                Touch(index);
            }
            SetValues(index, length, attenuation);
            return new LinkHandle(index, entry.Generation);
        }

        /// <summary>Grows whenever links were dropped: while it stays the same, no handle has become stale.</summary>
        internal int Drops { get; private set; }

        /// <summary>Gives a held link new values.</summary>
        /// <returns>False when the link is gone, because one of its nodes left.</returns>
        internal bool Update(LinkHandle handle, float length, float attenuation)
        {
            if (!Alive(handle)) return false;
            SetValues(handle.Index, length, attenuation);
            return true;
        }

        /// <summary>Ends one hold. Nothing happens when the link is gone already.</summary>
        internal void Release(LinkHandle handle)
        {
            if (!Alive(handle)) return;
            ref var entry = ref entries[handle.Index];
            if (--entry.Holders > 0) return;
            Count--;
            Touch(handle.Index);
        }

        /// <summary>Holds a link for scripts, at most once.</summary>
        internal void HoldForScripts(int from, int to, float length, float attenuation)
        {
            var index = Find(from, to);
            if (index != None && entries[index].ByScript)
            {
                SetValues(index, length, attenuation);
                return;
            }
            // Not in one expression: holding may replace the array.
            var handle = Hold(from, to, length, attenuation);
            entries[handle.Index].ByScript = true;
        }

        /// <summary>Ends the scripts' hold.</summary>
        /// <returns>False when scripts hold no such link.</returns>
        internal bool ReleaseForScripts(int from, int to)
        {
            var index = Find(from, to);
            if (index == None || !entries[index].ByScript) return false;
            entries[index].ByScript = false;
            Release(new LinkHandle(index, entries[index].Generation));
            return true;
        }

        /// <summary>Drops all links of nodes that left (<paramref name="isGone"/> by id); the JVM drops its own with the node.</summary>
        internal void DropLinksOf(bool[] isGone)
        {
            Drops++;
            for (var index = 0; index < Capacity; index++)
            {
                ref var entry = ref entries[index];
                if (entry.NextInBucket < None) continue;
                if (!isGone[entry.Link.From] && !isGone[entry.Link.To]) continue;
                if (entry.Holders > 0) Count--;
                entry.Sent = false;
                entry.Holders = 0;
                entry.ByScript = false;
                entry.Generation++;
                if (!entry.Dirty) Free(index);
            }
        }

        /// <summary>
        /// Writes to the request what changed since the last call. Links of nodes that the JVM does not know (<paramref name="isKnown"/>
        /// by id) wait for a later call.
        /// </summary>
        internal void Flush(StepRequest request, bool[] isKnown)
        {
            var waiting = 0;
            for (var i = 0; i < dirty.Count; i++)
            {
                var index = dirty.Items[i];
                ref var entry = ref entries[index];
                if (entry.Holders > 0 && !(isKnown[entry.Link.From] && isKnown[entry.Link.To]))
                {
                    dirty.Items[waiting++] = index;
                    continue;
                }
                entry.Dirty = false;
                if (entry.Holders > 0)
                {
                    request.SetLink(entry.Link);
                    entry.Sent = true;
                    continue;
                }
                if (entry.Sent) request.RemoveLink(new LinkEnds { From = entry.Link.From, To = entry.Link.To });
                Free(index);
            }
            dirty.Truncate(waiting);
        }

        private static int Hash(int from, int to)
        {
            var mixed = unchecked((uint)from * 0x9E3779B1u ^ (uint)to * 0x85EBCA77u);
            return unchecked((int)(mixed ^ mixed >> 15));
        }

        private bool Alive(LinkHandle handle)
        {
            ref var entry = ref entries[handle.Index];
            return entry.Generation == handle.Generation && entry.Holders > 0;
        }

        private void SetValues(int index, float length, float attenuation)
        {
            ref var link = ref entries[index].Link;
            if (link.Length == length && link.Attenuation == attenuation) return;
            link.Length = length;
            link.Attenuation = attenuation;
            Touch(index);
        }

        private void Touch(int index)
        {
            if (entries[index].Dirty) return;
            entries[index].Dirty = true;
            dirty.Add(index);
        }

        private int Find(int from, int to)
        {
            for (var index = buckets[Hash(from, to) & buckets.Length - 1]; index != None; index = entries[index].NextInBucket)
            {
                if (entries[index].Link.From == from && entries[index].Link.To == to) return index;
            }
            return None;
        }

        private int Insert(int from, int to)
        {
            int index;
            if (firstFree != None)
            {
                index = firstFree;
                firstFree = FreeLink(entries[index].NextInBucket);
            }
            else
            {
                if (Capacity == entries.Length) Grow();
                index = Capacity++;
            }
            ref var entry = ref entries[index];
            entry.Link = new LinkRecord { From = from, To = to };
            entry.Holders = 0;
            entry.Sent = false;
            entry.ByScript = false;
            Chain(index);
            return index;
        }

        /// <summary>A free entry's next one is kept below -1, so that free entries can be told from chained ones.</summary>
        private static int FreeLink(int next) => -3 - next;

        private void Free(int index)
        {
            ref var entry = ref entries[index];
            ref var head = ref buckets[Hash(entry.Link.From, entry.Link.To) & buckets.Length - 1];
            if (head == index)
            {
                head = entry.NextInBucket;
            }
            else
            {
                var previous = head;
                while (entries[previous].NextInBucket != index) previous = entries[previous].NextInBucket;
                entries[previous].NextInBucket = entry.NextInBucket;
            }
            entry.Generation++;
            entry.Holders = 0;
            entry.NextInBucket = FreeLink(firstFree);
            firstFree = index;
        }

        private void Chain(int index)
        {
            ref var head = ref buckets[Hash(entries[index].Link.From, entries[index].Link.To) & buckets.Length - 1];
            entries[index].NextInBucket = head;
            head = index;
        }

        private void Grow()
        {
            Array.Resize(ref entries, entries.Length * 2);
            buckets = new int[entries.Length];
            Array.Fill(buckets, None);
            for (var index = 0; index < Capacity; index++)
            {
                if (entries[index].NextInBucket >= None) Chain(index);
            }
        }
    }

    /// <summary>A hold on a link; stale once the link is gone.</summary>
    internal readonly struct LinkHandle
    {
        internal readonly int Index;
        internal readonly int Generation;

        internal LinkHandle(int index, int generation)
        {
            Index = index;
            Generation = generation;
        }
    }
}
