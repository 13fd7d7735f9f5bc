using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// A node's parts of one kind, in the order of their components and objects: Unity does not specify the order in which it enables them. A struct in the
    /// node rather than a separate object: in a large scene cache misses dominate a tick.
    /// </summary>
    internal struct PartList
    {
        private NodePart[] parts;
        private bool isUnsorted;

        internal int Count { get; private set; }

        internal NodePart this[int place] => parts[place];

        internal void Add(NodePart part)
        {
            if (parts == null || Count == parts.Length) Array.Resize(ref parts, Math.Max(2, 2 * Count));
            parts[Count++] = part;
            // Sorted later, because the list may be running.
            isUnsorted = Count > 1;
        }

        /// <summary>Removes a part; later parts move up. A missing part is ignored.</summary>
        internal void Remove(NodePart part)
        {
            var place = Count - 1;
            while (place >= 0 && !ReferenceEquals(parts[place], part)) place--;
            if (place < 0) return;
            Count--;
            Array.Copy(parts, place + 1, parts, place, Count - place);
            parts[Count] = null;
        }

        /// <summary>Calls the parts in a tick; parts that an earlier one disables, destroys or adds are skipped.</summary>
        /// <param name="node">The parts' node.</param>
        /// <returns>Whether no part threw an exception.</returns>
        internal bool Run(Simulation simulation, Node node, int index)
        {
            if (isUnsorted) Sort();
            var i = 0;
            var failed = false;
            for (var left = Count; left > 0 && i < Count && simulation.IsOpen; left--)
            {
                var part = parts[i];
                try
                {
                    part.Run(simulation.Context, index);
                    part.Succeeded();
                }
                catch (Exception error)
                {
                    simulation.Errors.AddPart(node, part, simulation.TickInProgress, error);
                    failed = true;
                }
                if (Has(i, part)) i++;
            }
            return !failed;
        }

        /// <summary>Whether a part is where it was before its call: the call may have disabled, destroyed or re-enabled it.</summary>
        private bool Has(int place, NodePart part) => place < Count && ReferenceEquals(parts[place], part);

        private void Sort()
        {
            isUnsorted = false;
            for (var next = 1; next < Count; next++)
            {
                var part = parts[next];
                var place = next;
                for (; place > 0 && IsBefore(part, parts[place - 1]); place--) parts[place] = parts[place - 1];
                parts[place] = part;
            }
        }

        /// <summary>Parents come before children, and siblings in their order.</summary>
        private static bool IsBefore(NodePart a, NodePart b)
        {
            var left = a.transform;
            var right = b.transform;
            if (left == right) return a.GetComponentIndex() < b.GetComponentIndex();
            var depth = DepthOf(left);
            var difference = depth - DepthOf(right);
            for (var i = 0; i < difference; i++) left = left.parent;
            for (var i = 0; i < -difference; i++) right = right.parent;
            if (left == right) return difference < 0;
            while (left.parent != right.parent)
            {
                left = left.parent;
                right = right.parent;
            }
            return left.GetSiblingIndex() < right.GetSiblingIndex();
        }

        private static int DepthOf(Transform transform)
        {
            var depth = 0;
            for (var parent = transform.parent; parent != null; parent = parent.parent) depth++;
            return depth;
        }
    }
}
