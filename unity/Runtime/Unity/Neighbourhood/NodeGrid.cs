using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Where all nodes are at this tick, in cubic cells: finding the nodes around a point costs the nodes near it, not all of them.
    /// A search over more cells than there are nodes looks at all nodes instead.
    /// Built once per tick; no allocation once its capacity is reached.
    /// </summary>
    internal sealed class NodeGrid
    {
        /// <summary>Beyond this a cell's number would not fit an int.</summary>
        private const float MaxCells = 1 << 30;

        /// <summary>Metres. No search needs to be larger, and its square still fits a float.</summary>
        private const float MaxRadius = 1e18f;

        // By place in the list of nodes.
        private Entry[] unsorted = new Entry[64];
        private Node[] nodes = new Node[64];
        // By bucket: the nodes of one cell lie side by side.
        private Entry[] entries = new Entry[64];
        private int[] starts = new int[129];
        private int count;
        private Hit[] hits = new Hit[64];
        private int hitCount;
        private int mask;
        private float cellSize = 1;
        // The cells that hold all nodes: a swarm on the ground has one layer of them.
        private Cell least;
        private Cell most;
        private double asked;
        private int searches;

        private struct Cell
        {
            internal int X;
            internal int Y;
            internal int Z;
        }

        private struct Entry
        {
            internal Vector3 Position;
            internal Cell Cell;
            internal int Place;
            internal int Id;
        }

        /// <summary>A node near a point.</summary>
        internal struct Hit
        {
            internal int Place;
            internal int Id;
            internal float Distance;
        }

        /// <summary>
        /// Mean radius in metres of the searches since the grid was built; that of the time before while there was none. The mean and not the
        /// largest, so that one node with a long reach does not put all others into one cell.
        /// </summary>
        internal float MeanRadius => searches == 0 ? cellSize : (float)(asked / searches);

        /// <summary>Takes the positions of all nodes, for searches of about <paramref name="radius"/> metres.</summary>
        internal void Build(List<Node> all, float radius)
        {
            count = all.Count;
            cellSize = Math.Min(Math.Max(radius, 1e-3f), MaxRadius);
            asked = 0;
            searches = 0;
            least = new Cell { X = int.MaxValue, Y = int.MaxValue, Z = int.MaxValue };
            most = new Cell { X = int.MinValue, Y = int.MinValue, Z = int.MinValue };
            EnsureCapacity();
            Array.Clear(starts, 0, mask + 2);
            for (var i = 0; i < count; i++)
            {
                nodes[i] = all[i];
                ref var entry = ref unsorted[i];
                entry.Position = all[i].Body.position;
                entry.Cell = CellOf(entry.Position);
                entry.Place = i;
                entry.Id = all[i].Id;
                Include(entry.Cell);
                starts[Bucket(entry.Cell) + 1]++;
            }
            for (var bucket = 0; bucket <= mask; bucket++) starts[bucket + 1] += starts[bucket];
            for (var i = count - 1; i >= 0; i--)
            {
                ref var entry = ref unsorted[i];
                entries[--starts[Bucket(entry.Cell) + 1]] = entry;
            }
            // Each starts[bucket + 1] now holds its bucket's beginning: move them back by one.
            for (var bucket = 0; bucket <= mask; bucket++) starts[bucket] = starts[bucket + 1];
            starts[mask + 1] = count;
        }

        /// <summary>The nodes within <paramref name="radius"/> metres of a point, in no order; valid until the next search.</summary>
        internal Span<Hit> Find(Vector3 centre, float radius)
        {
            Count(radius);
            Collect(centre, radius);
            return new Span<Hit>(hits, 0, hitCount);
        }

        /// <summary>
        /// The nodes nearest to a point, at most <paramref name="wanted"/> (1 or more), by distance and at equal distances by id; valid until the next
        /// search. It is fastest when <paramref name="guess"/> metres hold a few more than these.
        /// </summary>
        internal Span<Hit> FindNearest(Vector3 centre, int wanted, float guess)
        {
            var radius = Math.Max(guess, 1e-3f);
            Collect(centre, radius);
            while (hitCount < wanted && hitCount < count && radius < MaxRadius)
            {
                radius *= 2;
                Collect(centre, radius);
            }
            Count(radius);
            return new Span<Hit>(hits, 0, MoveNearestToFront(wanted));
        }

        /// <summary>The node of a hit.</summary>
        internal Node NodeAt(in Hit hit) => nodes[hit.Place];

        private void Count(float radius)
        {
            asked += Math.Min(radius, MaxRadius);
            searches++;
        }

        private void Collect(Vector3 centre, float radius)
        {
            hitCount = 0;
            var squared = radius * radius;
            var reach = Math.Ceiling(radius / cellSize);
            var side = 2 * reach + 1;
            if (!(side * side * side <= count))
            {
                Test(0, count, centre, squared, false, default);
                return;
            }
            var near = (int)reach;
            var middle = CellOf(centre);
            var from = new Cell { X = Math.Max(middle.X - near, least.X), Y = Math.Max(middle.Y - near, least.Y), Z = Math.Max(middle.Z - near, least.Z) };
            var to = new Cell { X = Math.Min(middle.X + near, most.X), Y = Math.Min(middle.Y + near, most.Y), Z = Math.Min(middle.Z + near, most.Z) };
            Cell cell;
            for (cell.X = from.X; cell.X <= to.X; cell.X++)
            {
                for (cell.Y = from.Y; cell.Y <= to.Y; cell.Y++)
                {
                    for (cell.Z = from.Z; cell.Z <= to.Z; cell.Z++)
                    {
                        var bucket = Bucket(cell);
                        Test(starts[bucket], starts[bucket + 1], centre, squared, true, cell);
                    }
                }
            }
        }

        /// <summary>
        /// Takes the entries of a range that are near enough, of one cell alone or of all: others may share its bucket. Most of a search is
        /// spent in this loop; locals are what Mono is fast with.
        /// </summary>
        private void Test(int start, int end, Vector3 centre, float squaredRadius, bool ofCell, Cell cell)
        {
            var centreX = centre.x;
            var centreY = centre.y;
            var centreZ = centre.z;
            var cellX = cell.X;
            var cellY = cell.Y;
            var cellZ = cell.Z;
            var all = entries;
            for (var i = start; i < end; i++)
            {
                ref var entry = ref all[i];
                var dx = entry.Position.x - centreX;
                var dy = entry.Position.y - centreY;
                var dz = entry.Position.z - centreZ;
                var squared = dx * dx + dy * dy + dz * dz;
                if (!(squared <= squaredRadius)) continue;
                if (ofCell && (entry.Cell.X != cellX || entry.Cell.Z != cellZ || entry.Cell.Y != cellY)) continue;
                if (hitCount == hits.Length) Array.Resize(ref hits, hitCount * 2);
                ref var hit = ref hits[hitCount++];
                hit.Place = entry.Place;
                hit.Id = entry.Id;
                hit.Distance = (float)Math.Sqrt(squared);
            }
        }

        /// <returns>How many there are: <paramref name="wanted"/>, or all hits if these are fewer.</returns>
        private int MoveNearestToFront(int wanted)
        {
            var sorted = 0;
            for (var i = 0; i < hitCount; i++)
            {
                var hit = hits[i];
                if (sorted == wanted && !IsNearer(hit, hits[sorted - 1])) continue;
                var place = sorted < wanted ? sorted++ : sorted - 1;
                // The hit in the way was looked at before, or is the farthest of those wanted.
                for (; place > 0 && IsNearer(hit, hits[place - 1]); place--) hits[place] = hits[place - 1];
                hits[place] = hit;
            }
            return sorted;
        }

        private static bool IsNearer(in Hit a, in Hit b) => a.Distance < b.Distance || a.Distance == b.Distance && a.Id < b.Id;

        private void Include(in Cell cell)
        {
            least.X = Math.Min(least.X, cell.X);
            least.Y = Math.Min(least.Y, cell.Y);
            least.Z = Math.Min(least.Z, cell.Z);
            most.X = Math.Max(most.X, cell.X);
            most.Y = Math.Max(most.Y, cell.Y);
            most.Z = Math.Max(most.Z, cell.Z);
        }

        private Cell CellOf(Vector3 position) => new Cell { X = CellOf(position.x), Y = CellOf(position.y), Z = CellOf(position.z) };

        private int CellOf(float coordinate) => (int)Math.Floor(Math.Min(Math.Max(coordinate / cellSize, -MaxCells), MaxCells));

        private int Bucket(in Cell cell)
        {
            var mixed = unchecked((uint)cell.X * 0x8DA6B343u ^ (uint)cell.Y * 0xD8163841u ^ (uint)cell.Z * 0xCB1AB31Fu);
            return (int)(mixed ^ mixed >> 16) & mask;
        }

        private void EnsureCapacity()
        {
            if (count > nodes.Length)
            {
                var capacity = Math.Max(count, nodes.Length * 2);
                unsorted = new Entry[capacity];
                entries = new Entry[capacity];
                nodes = new Node[capacity];
            }
            var buckets = starts.Length - 1;
            while (buckets < 2 * count) buckets *= 2;
            if (buckets + 1 > starts.Length) starts = new int[buckets + 1];
            mask = buckets - 1;
        }
    }
}
