using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// The positions of all nodes at this tick, in cubic cells: a search around a point costs as much as there are nodes near it.
    /// A search over more cells than nodes checks all nodes instead.
    /// Built once per tick, which also gives the nodes their <see cref="Node.Position"/>; no allocation once its capacity is reached.
    /// </summary>
    internal sealed class NodeGrid : IDisposable
    {
        /// <summary>Beyond this a cell's number would not fit an int.</summary>
        private const int MaxCells = 1 << 30;

        /// <summary>Rows beyond this number share a number.</summary>
        private const int MaxRows = 0xFFFF;

        /// <summary>Metres. Searches need no larger radius, and its square fits a float.</summary>
        private const float MaxRadius = 1e18f;

        // By place in the list of nodes.
        private Entry[] unsorted = new Entry[64];
        private int[] bucketOf = new int[64];
        private Node[] nodes = new Node[64];
        // Metres: around which nodes the second thread searches how far.
        private float[] expected = new float[64];
        // By bucket: the nodes of one cell lie side by side.
        private Entry[] entries = new Entry[64];
        private int[] starts = new int[129];
        private int count;
        private readonly NearNodes hits = new NearNodes();
        private readonly BackgroundSearch ahead;
        private int mask;
        private float cellSize = 1;
        private double cellsPerMetre = 1;
        // The range of cells that contain nodes: a swarm on the ground has one layer of cells.
        private Cell least;
        private Cell most;
        private double radiusSum;
        private int searches;

        internal NodeGrid() => ahead = new BackgroundSearch(this);

        private struct Cell
        {
            internal int X;
            internal int Y;
            internal int Z;
        }

        private struct Entry
        {
            internal float X;
            internal float Y;
            internal float Z;
            internal int Row;
            internal int Place;
            internal int Id;
        }

        /// <summary>
        /// Mean radius in metres of the searches since the grid was built, or of the previous grid before the first search. The mean and not the
        /// largest, so that one node with a long reach does not put all others into one cell.
        /// </summary>
        internal float MeanRadius => searches == 0 ? cellSize : (float)(radiusSum / searches);

        /// <summary>
        /// Takes the positions of all nodes, for searches of about <paramref name="radius"/> metres. If it <paramref name="maySearchAhead"/>, a second
        /// thread begins to search around the nodes.
        /// </summary>
        internal void Build(List<Node> all, float radius, bool maySearchAhead = false)
        {
            ahead.End();
            count = all.Count;
            cellSize = Math.Min(Math.Max(radius, 1e-3f), MaxRadius);
            cellsPerMetre = 1 / (double)cellSize;
            radiusSum = 0;
            searches = 0;
            least = new Cell { X = int.MaxValue, Y = int.MaxValue, Z = int.MaxValue };
            most = new Cell { X = int.MinValue, Y = int.MinValue, Z = int.MinValue };
            EnsureCapacity();
            Array.Clear(starts, 0, mask + 2);
            all.CopyTo(nodes);
            // Each node is far away in memory. A processor looks further ahead in a short loop.
            for (var i = 0; i < count; i++)
            {
                var node = nodes[i];
                var position = node.Body.position;
                node.Position = position;
                node.PlaceInGrid = i;
                expected[i] = node.SearchRadius;
                ref var entry = ref unsorted[i];
                entry.X = position.x;
                entry.Y = position.y;
                entry.Z = position.z;
                entry.Place = i;
                entry.Id = node.Id;
            }
            for (var i = 0; i < count; i++)
            {
                ref var entry = ref unsorted[i];
                var cell = new Cell { X = CellOf(entry.X), Y = CellOf(entry.Y), Z = CellOf(entry.Z) };
                Include(cell);
                entry.Row = Row(cell.Y, cell.Z);
                var bucket = Bucket(cell.X, entry.Row);
                bucketOf[i] = bucket;
                starts[bucket + 1]++;
            }
            for (var bucket = 0; bucket <= mask; bucket++) starts[bucket + 1] += starts[bucket];
            for (var i = count - 1; i >= 0; i--) entries[--starts[bucketOf[i] + 1]] = unsorted[i];
            // Each starts[bucket + 1] now holds its bucket's beginning: move them back by one.
            for (var bucket = 0; bucket <= mask; bucket++) starts[bucket] = starts[bucket + 1];
            starts[mask + 1] = count;
            if (maySearchAhead && count >= BackgroundSearch.MinNodes) ahead.Begin(count);
        }

        /// <summary>The nodes within <paramref name="radius"/> metres of a point, in no order; valid until the next search.</summary>
        internal Span<NearNode> Find(Vector3 centre, float radius)
        {
            Count(radius);
            hits.Count = 0;
            Collect(centre, radius, hits);
            return hits.From(0);
        }

        /// <summary><see cref="Find"/> around a node's position. The second thread expects the same search in the next tick.</summary>
        internal Span<NearNode> FindAround(Node node, float radius)
        {
            node.SearchRadius = radius;
            var place = node.PlaceInGrid;
            if (place >= count || !ReferenceEquals(nodes[place], node) || expected[place] != radius || !ahead.TryTake(place, out var found))
                return Find(node.Position, radius);
            Count(radius);
            return found;
        }

        /// <summary>Appends the expected results of <see cref="FindAround"/> to <paramref name="to"/>; none for a node without a previous search.</summary>
        internal void SearchAround(int place, NearNodes to)
        {
            if (!(expected[place] > 0)) return;
            ref var entry = ref unsorted[place];
            Collect(new Vector3(entry.X, entry.Y, entry.Z), expected[place], to);
        }

        /// <summary>Ends the second thread, until the next <see cref="Build"/>.</summary>
        public void Dispose() => ahead.Dispose();

        /// <summary>
        /// The nodes nearest to a point, at most <paramref name="limit"/> (1 or more), by distance and at equal distances by id; valid until the next
        /// search. It is fastest when <paramref name="guess"/> metres hold a few more than these.
        /// </summary>
        internal Span<NearNode> FindNearest(Vector3 centre, int limit, float guess)
        {
            var radius = Math.Max(guess, 1e-3f);
            hits.Count = 0;
            Collect(centre, radius, hits);
            while (hits.Count < limit && hits.Count < count && radius < MaxRadius)
            {
                radius *= 2;
                hits.Count = 0;
                Collect(centre, radius, hits);
            }
            Count(radius);
            return new Span<NearNode>(hits.Items, 0, MoveNearestToFront(limit));
        }

        /// <summary>Copies hits to lists, emptied first.</summary>
        internal void Copy(Span<NearNode> found, List<Node> to, List<float> distances)
        {
            to.Clear();
            distances.Clear();
            for (var i = 0; i < found.Length; i++)
            {
                to.Add(NodeAt(found[i]));
                distances.Add(found[i].Distance);
            }
        }

        /// <summary>The node of a hit.</summary>
        internal Node NodeAt(in NearNode hit) => nodes[hit.Place];

        private void Count(float radius)
        {
            if (!(radius >= 0)) return;
            radiusSum += Math.Min(radius, MaxRadius);
            searches++;
        }

        /// <summary>Appends the nodes near a point. Thread-safe, because it does not change the grid.</summary>
        private void Collect(Vector3 centre, float radius, NearNodes to)
        {
            if (!(radius >= 0)) return;
            var squared = radius * radius;
            // A little more, since distances are rounded.
            var reach = radius * (1 + 1e-6);
            var first = new Cell
            {
                X = Math.Max(CellOf(centre.x - reach), least.X), Y = Math.Max(CellOf(centre.y - reach), least.Y),
                Z = Math.Max(CellOf(centre.z - reach), least.Z),
            };
            var last = new Cell
            {
                X = Math.Min(CellOf(centre.x + reach), most.X), Y = Math.Min(CellOf(centre.y + reach), most.Y), Z = Math.Min(CellOf(centre.z + reach), most.Z),
            };
            var length = (long)last.X - first.X + 1;
            var rows = ((long)last.Y - first.Y + 1) * ((long)last.Z - first.Z + 1);
            if (length <= 0) return;
            // A double: the number of cells may exceed the range of long.
            if ((double)length * rows > count || rows > MaxRows)
            {
                AddNear(0, count, centre, squared, false, 0, to);
                return;
            }
            for (var y = first.Y; y <= last.Y; y++)
            {
                for (var z = first.Z; z <= last.Z; z++)
                {
                    var row = Row(y, z);
                    var start = Bucket(first.X, row);
                    var end = start + (int)length;
                    AddNear(starts[start], starts[Math.Min(end, mask + 1)], centre, squared, true, row, to);
                    if (end > mask + 1) AddNear(0, starts[end - mask - 1], centre, squared, true, row, to);
                }
            }
        }

        /// <summary>
        /// Takes the entries of a range that are near enough, of one row alone or of all: others may share its buckets. Most of a search is spent
        /// in this loop; Mono is fastest with locals.
        /// </summary>
        private void AddNear(int start, int end, Vector3 centre, float squaredRadius, bool ofRow, int row, NearNodes to)
        {
            var centreX = centre.x;
            var centreY = centre.y;
            var centreZ = centre.z;
            var all = entries;
            var near = to.WithRoomFor(end - start);
            var found = to.Count;
            for (var i = start; i < end; i++)
            {
                ref var entry = ref all[i];
                var dx = entry.X - centreX;
                var dy = entry.Y - centreY;
                var dz = entry.Z - centreZ;
                var squared = dx * dx + dy * dy + dz * dz;
                if (!(squared <= squaredRadius)) continue;
                if (ofRow && entry.Row != row) continue;
                ref var hit = ref near[found++];
                hit.Place = entry.Place;
                hit.IdOfNode = entry.Id;
                hit.Metres = (float)Math.Sqrt(squared);
            }
            to.Count = found;
        }

        /// <returns>How many there are: <paramref name="limit"/>, or all hits if these are fewer.</returns>
        private int MoveNearestToFront(int limit)
        {
            var all = hits.Items;
            var sorted = 0;
            for (var i = 0; i < hits.Count; i++)
            {
                var hit = all[i];
                if (sorted == limit && !IsNearer(hit, all[sorted - 1])) continue;
                var place = sorted < limit ? sorted++ : sorted - 1;
                // The replaced hit was already checked, or is the farthest of the requested ones.
                for (; place > 0 && IsNearer(hit, all[place - 1]); place--) all[place] = all[place - 1];
                all[place] = hit;
            }
            return sorted;
        }

        private static bool IsNearer(in NearNode a, in NearNode b) => a.Metres < b.Metres || a.Metres == b.Metres && a.IdOfNode < b.IdOfNode;

        private void Include(in Cell cell)
        {
            least.X = Math.Min(least.X, cell.X);
            least.Y = Math.Min(least.Y, cell.Y);
            least.Z = Math.Min(least.Z, cell.Z);
            most.X = Math.Max(most.X, cell.X);
            most.Y = Math.Max(most.Y, cell.Y);
            most.Z = Math.Max(most.Z, cell.Z);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private int CellOf(double coordinate)
        {
            var cell = coordinate * cellsPerMetre;
            if (!(cell > -MaxCells)) return -MaxCells;
            if (cell >= MaxCells) return MaxCells;
            // Rounded down; Math.Floor is a call on Mono.
            var towardsZero = (int)cell;
            return cell < towardsZero ? towardsZero - 1 : towardsZero;
        }

        /// <summary>The number of a row of cells along x: no two rows of one search have the same.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static int Row(int y, int z) => y << 16 | z & MaxRows;

        /// <summary>Cells that are neighbours along x have neighbouring buckets, so that a row of them is one range of entries.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private int Bucket(int x, int row)
        {
            var mixed = unchecked((uint)row * 0x9E3779B1u);
            return unchecked(x + (int)(mixed ^ mixed >> 15)) & mask;
        }

        private void EnsureCapacity()
        {
            if (count > nodes.Length)
            {
                var capacity = Math.Max(count, nodes.Length * 2);
                unsorted = new Entry[capacity];
                entries = new Entry[capacity];
                bucketOf = new int[capacity];
                nodes = new Node[capacity];
                expected = new float[capacity];
            }
            var buckets = starts.Length - 1;
            while (buckets < 2 * count) buckets *= 2;
            if (buckets + 1 > starts.Length) starts = new int[buckets + 1];
            mask = buckets - 1;
        }
    }
}
