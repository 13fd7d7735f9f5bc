using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Errors for the console: each is logged whole when it comes for the first time, then counted. Errors with equal keys are the same error, on any node.
    /// </summary>
    internal sealed class RepeatedErrors
    {
        private const int MaxKinds = 256;
        private const string Others = "errors of other kinds";

        private readonly Dictionary<string, Kind> kinds = new Dictionary<string, Kind>();

        /// <summary>Counts an error, and logs its count when it has come 10, 100, 1000... times.</summary>
        /// <param name="what">What happened, in the plural, for instance <c>rounds of program 'p' have failed so</c>.</param>
        /// <param name="first">The first one, in a line.</param>
        /// <returns>Whether it is the first one, which the caller logs.</returns>
        internal bool IsFirst(string key, string what, int node, string first)
        {
            if (!kinds.ContainsKey(key) && kinds.Count >= MaxKinds) key = Others;
            if (!kinds.TryGetValue(key, out var kind))
            {
                kind = key == Others ? new Kind("rounds or components have failed", Others) : new Kind(what, first);
                kinds.Add(key, kind);
            }
            kind.Count++;
            kind.LastNode = node;
            if (kind.Count > 1 && IsPowerOfTen(kind.Count)) kind.Tell();
            return kind.Count == 1;
        }

        /// <summary>Logs how often each error has come, if more than once, and forgets them all.</summary>
        internal void TellCounts()
        {
            foreach (var kind in kinds.Values)
            {
                if (kind.Count > 1 && !IsPowerOfTen(kind.Count)) kind.Tell();
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

            internal void Tell() => Debug.LogError(Count + " " + what + ", the last one of node " + LastNode + "; the first one: " + first);
        }
    }
}
