using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// The parts of one kind of a node. They are sorted by their position in the hierarchy, because Unity does not specify the order in which it enables
    /// components. The list is a struct within the node rather than a separate object, because cache misses dominate a tick in a large scene.
    /// </summary>
    internal struct PartList
    {
        private NodePart[] parts;
        private bool isUnsorted;
        // During a run: the index of the next part, and the end of the parts that run. Both change if a part removes itself or others.
        private int next;
        private int end;

        internal int Count { get; private set; }

        internal NodePart this[int index] => parts[index];

        internal void Add(NodePart part)
        {
            if (parts == null || Count == parts.Length) Array.Resize(ref parts, Math.Max(2, 2 * Count));
            parts[Count++] = part;
            // The list is sorted later, because its parts may be running now.
            isUnsorted = Count > 1;
        }

        /// <summary>Removes a part, and moves later parts up. Does nothing if the part is not in the list.</summary>
        internal void Remove(NodePart part)
        {
            var index = Count - 1;
            while (index >= 0 && !ReferenceEquals(parts[index], part)) index--;
            if (index < 0) return;
            Count--;
            if (index < next) next--;
            if (index < end) end--;
            Array.Copy(parts, index + 1, parts, index, Count - index);
            parts[Count] = null;
        }

        /// <summary>
        /// Calls the parts in a tick. Parts that an earlier part disabled, destroyed or added are skipped, and all later parts if their node has left.
        /// </summary>
        /// <param name="node">The parts' node.</param>
        /// <returns>Whether no part threw an exception.</returns>
        internal bool Run(Simulation simulation, Node node, int index)
        {
            if (isUnsorted) Sort();
            var failed = false;
            next = 0;
            end = Count;
            while (next < end && simulation.IsOpen && node.IsInTick)
            {
                var part = parts[next++];
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
            }
            return !failed;
        }

        private void Sort()
        {
            isUnsorted = false;
            for (var i = 1; i < Count; i++)
            {
                var part = parts[i];
                var position = i;
                for (; position > 0 && IsBefore(part, parts[position - 1]); position--) parts[position] = parts[position - 1];
                parts[position] = part;
            }
        }

        /// <summary>
        /// Returns whether <paramref name="a"/> precedes <paramref name="b"/> in the hierarchy. Parents precede their children, and siblings keep their
        /// order.
        /// </summary>
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
