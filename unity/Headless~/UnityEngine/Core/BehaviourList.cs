using System;
using System.Collections.Generic;

namespace UnityEngine
{
    /// Scripts sorted by execution order, then by the time they were enabled. A script that is enabled during a pass is first called in the next pass. A
    /// script that is disabled is skipped immediately.
    sealed class BehaviourList
    {
        readonly struct Entry
        {
            public readonly MonoBehaviour Script;
            readonly int enabling;
            readonly int rank;

            public Entry(MonoBehaviour script)
            {
                Script = script;
                enabling = script.enabling;
                rank = Orders.IsPermuted ? Orders.Next() : enabling;
            }

            public bool IsCurrent => Script.enabling == enabling;

            public static int Compare(Entry a, Entry b)
            {
                var byOrder = a.Script.messages.Order.CompareTo(b.Script.messages.Order);
                return byOrder != 0 ? byOrder : a.rank.CompareTo(b.rank);
            }
        }

        static readonly Comparison<Entry> InOrder = Entry.Compare;
        static readonly Predicate<Entry> Stale = entry => !entry.IsCurrent;

        readonly List<Entry> entries = new List<Entry>();
        readonly List<Entry> added = new List<Entry>();
        bool hasStale;

        public bool HasNew => added.Count > 0;

        public void Add(MonoBehaviour script) => added.Add(new Entry(script));

        /// Starts a pass. Passes of one list cannot be nested.
        public int Begin()
        {
            if (hasStale) entries.RemoveAll(Stale);
            hasStale = false;
            if (added.Count > 0)
            {
                added.RemoveAll(Stale);
                entries.AddRange(added);
                added.Clear();
                entries.Sort(InOrder);
            }
            if (!Orders.IsPermuted) return 0;
            for (var i = 0; i < entries.Count; i++) entries[i] = entries[i].IsCurrent ? new Entry(entries[i].Script) : entries[i];
            entries.Sort(InOrder);
            return 0;
        }

        public bool Next(ref int cursor, out MonoBehaviour script)
        {
            while (cursor < entries.Count)
            {
                var entry = entries[cursor++];
                if (entry.IsCurrent)
                {
                    script = entry.Script;
                    return true;
                }
                hasStale = true;
            }
            script = null;
            return false;
        }

        public void ClearOld() => entries.Clear();

        public void Clear()
        {
            entries.Clear();
            added.Clear();
        }
    }
}
