using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Errors of rounds for the console: each is logged at its first occurrence, then counted. Errors with the same program, exception
    /// and place in the code are the same error, whatever the node.
    /// </summary>
    internal sealed class RepeatedErrors
    {
        private const int MaxKinds = 256;
        private const string Others = "errors of other kinds";

        private readonly Dictionary<string, Kind> kinds = new Dictionary<string, Kind>();

        /// <summary>Logs the error of a round, or its count when it has come 10, 100, 1000... times.</summary>
        internal void Report(int node, string program, ulong tick, string message, Object context)
        {
            var key = Key(program, message);
            if (!kinds.ContainsKey(key) && kinds.Count >= MaxKinds) key = Others;
            if (!kinds.TryGetValue(key, out var kind))
            {
                kind = new Kind(program, key == Others ? Others : FirstLine(message));
                kinds.Add(key, kind);
                Debug.LogError("round of node " + node + " (program '" + program + "') failed at tick " + tick + ": " + message, context);
            }
            kind.Count++;
            kind.LastNode = node;
            if (kind.Count > 1 && IsPowerOfTen(kind.Count)) kind.Tell();
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

        /// <summary>Without the text of the message, which may contain numbers, if there is a stack to identify the error.</summary>
        private static string Key(string program, string message)
        {
            var stack = message.IndexOf('\n');
            var words = message.IndexOf(':');
            return stack < 0 || words < 0 || words > stack ? program + message : program + message.Substring(0, words) + message.Substring(stack);
        }

        private static string FirstLine(string message)
        {
            var end = message.IndexOf('\n');
            return end < 0 ? message : message.Substring(0, end);
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
            private readonly string program;
            private readonly string first;

            internal Kind(string program, string first)
            {
                this.program = program;
                this.first = first;
            }

            internal void Tell()
            {
                Debug.LogError(Count + " rounds of program '" + program + "' have failed so, the last one of node " + LastNode + "; the first one: " + first);
            }
        }
    }
}
