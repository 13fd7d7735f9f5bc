using System;
using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Where all nodes are at this tick, in cubic cells: finding the nodes around a point costs the nodes near it, not all of them.
    /// Built once per tick; no allocation once its capacity is reached.
    /// </summary>
    internal sealed class NodeGrid
    {
        private Vector3[] positions = new Vector3[64];
        private Cell[] cells = new Cell[64];
        private int[] order = new int[64];
        private int[] starts = new int[129];
        private int[] ids = new int[64];
        private Node[] nodes = new Node[64];
        private int count;
        private Hit[] hits = new Hit[64];
        private int hitCount;
        private int mask;
        private float cellSize = 1;

        private struct Cell
        {
            internal int X;
            internal int Y;
            internal int Z;
            internal int Bucket;
        }

        /// <summary>A node near a point.</summary>
        internal struct Hit
        {
            internal int Place;
            internal int Id;
            internal float Distance;
        }

        /// <summary>Takes the positions of all nodes, for searches of about <paramref name="radius"/> metres.</summary>
        internal void Build(List<Node> all, float radius)
        {
            count = all.Count;
            cellSize = Math.Max(radius, 1e-3f);
            EnsureCapacity();
            Array.Clear(starts, 0, mask + 2);
            for (var i = 0; i < count; i++)
            {
                var position = all[i].Body.position;
                nodes[i] = all[i];
                ids[i] = all[i].Id;
                positions[i] = position;
                cells[i] = CellOf(position);
                starts[cells[i].Bucket + 1]++;
            }
            for (var bucket = 0; bucket <= mask; bucket++) starts[bucket + 1] += starts[bucket];
            for (var i = count - 1; i >= 0; i--) order[--starts[cells[i].Bucket + 1]] = i;
            // Each starts[bucket + 1] now holds its bucket's beginning: move them back by one.
            for (var bucket = 0; bucket <= mask; bucket++) starts[bucket] = starts[bucket + 1];
            starts[mask + 1] = count;
        }

        /// <summary>The nodes within <paramref name="radius"/> metres of a point, in no order; valid until the next search.</summary>
        internal Span<Hit> Find(Vector3 centre, float radius)
        {
            hitCount = 0;
            var reach = (int)Math.Ceiling(radius / cellSize);
            var middle = CellOf(centre);
            for (var x = middle.X - reach; x <= middle.X + reach; x++)
            {
                for (var y = middle.Y - reach; y <= middle.Y + reach; y++)
                {
                    for (var z = middle.Z - reach; z <= middle.Z + reach; z++) FindInCell(x, y, z, centre, radius * radius);
                }
            }
            return new Span<Hit>(hits, 0, hitCount);
        }

        /// <summary>The node of a hit.</summary>
        internal Node NodeAt(in Hit hit) => nodes[hit.Place];

        private void FindInCell(int x, int y, int z, Vector3 centre, float squaredRadius)
        {
            var bucket = Bucket(x, y, z);
            var end = starts[bucket + 1];
            for (var i = starts[bucket]; i < end; i++)
            {
                var place = order[i];
                ref var cell = ref cells[place];
                // Other cells may share the bucket.
                if (cell.X != x || cell.Z != z || cell.Y != y) continue;
                ref var position = ref positions[place];
                var dx = position.x - centre.x;
                var dy = position.y - centre.y;
                var dz = position.z - centre.z;
                var squared = dx * dx + dy * dy + dz * dz;
                if (squared > squaredRadius) continue;
                if (hitCount == hits.Length) Array.Resize(ref hits, hitCount * 2);
                ref var hit = ref hits[hitCount++];
                hit.Place = place;
                hit.Id = ids[place];
                hit.Distance = (float)Math.Sqrt(squared);
            }
        }

        private Cell CellOf(Vector3 position)
        {
            var cell = new Cell
            {
                X = (int)Math.Floor(position.x / cellSize),
                Y = (int)Math.Floor(position.y / cellSize),
                Z = (int)Math.Floor(position.z / cellSize),
            };
            cell.Bucket = Bucket(cell.X, cell.Y, cell.Z);
            return cell;
        }

        private int Bucket(int x, int y, int z)
        {
            var mixed = unchecked((uint)x * 0x8DA6B343u ^ (uint)y * 0xD8163841u ^ (uint)z * 0xCB1AB31Fu);
            return (int)(mixed ^ mixed >> 16) & mask;
        }

        private void EnsureCapacity()
        {
            if (count > positions.Length)
            {
                var capacity = Math.Max(count, positions.Length * 2);
                positions = new Vector3[capacity];
                cells = new Cell[capacity];
                order = new int[capacity];
                ids = new int[capacity];
                nodes = new Node[capacity];
            }
            var buckets = starts.Length - 1;
            while (buckets < 2 * count) buckets *= 2;
            if (buckets + 1 > starts.Length) starts = new int[buckets + 1];
            mask = buckets - 1;
        }
    }
}
