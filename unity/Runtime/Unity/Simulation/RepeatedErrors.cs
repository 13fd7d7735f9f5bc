using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Counts errors that occur repeatedly, so that each is logged in full only once. Errors with the same key count as the same error, whichever node they
    /// occur on.
    /// </summary>
    internal sealed class RepeatedErrors
    {
        private const int MaxKinds = 256;
        private const string Others = "different errors";

        private readonly Dictionary<string, Kind> kinds = new Dictionary<string, Kind>();

        /// <summary>Counts an error, and logs the count after 10, 100, 1000... occurrences.</summary>
        /// <param name="what">Text for the count, in the plural, for example <c>rounds of program 'p' failed in the same way</c>.</param>
        /// <param name="first">The first error, in one line.</param>
        /// <returns>Whether this is the first occurrence, which the caller must log.</returns>
        internal bool IsFirst(string key, string what, int node, string first)
        {
            if (!kinds.ContainsKey(key) && kinds.Count >= MaxKinds) key = Others;
            if (!kinds.TryGetValue(key, out var kind))
            {
                kind = key == Others ? new Kind("rounds or components failed", Others) : new Kind(what, first);
                kinds.Add(key, kind);
            }
            kind.Count++;
            kind.LastNode = node;
            if (kind.Count > 1 && IsPowerOfTen(kind.Count)) kind.LogCount();
            return kind.Count == 1;
        }

        /// <summary>Logs the counts of repeated errors, and resets them.</summary>
        internal void LogCounts()
        {
            foreach (var kind in kinds.Values)
            {
                if (kind.Count > 1 && !IsPowerOfTen(kind.Count)) kind.LogCount();
            }
            kinds.Clear();
        }

        private static bool IsPowerOfTen(long count)
        {
            while (count % 10 == 0) count /= 10;
            return count == 1;
        }

        private sealed class Kind
        {
            internal long Count;
            internal int LastNode;
            private readonly string what;
            private readonly string first;

            internal Kind(string what, string first)
            {
                this.what = what;
                this.first = first;
            }

            internal void LogCount() => Debug.LogError(Count + " " + what + ", most recently on node " + LastNode + ". First error: " + first);
        }
    }
}
