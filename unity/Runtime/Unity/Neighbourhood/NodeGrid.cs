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
        private IReadOnlyList<Node> nodes = Array.Empty<Node>();
        private int count;
        private int mask;
        private float cellSize = 1;

        private struct Cell
        {
            internal int X;
            internal int Y;
            internal int Z;
            internal int Bucket;
        }

        /// <summary>Takes the positions of all nodes, for searches of about <paramref name="radius"/> metres.</summary>
        internal void Build(IReadOnlyList<Node> all, float radius)
        {
            nodes = all;
            count = all.Count;
            cellSize = Math.Max(radius, 1e-3f);
            EnsureCapacity();
            Array.Clear(starts, 0, mask + 2);
            for (var i = 0; i < count; i++)
            {
                var position = all[i].Body.position;
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

        /// <summary>The nodes within <paramref name="radius"/> metres of a point, in no order, with their distances.</summary>
        internal void Find(Vector3 centre, float radius, List<Node> found, List<float> distances)
        {
            found.Clear();
            distances.Clear();
            var reach = (int)Math.Ceiling(radius / cellSize);
            var middle = CellOf(centre);
            for (var x = middle.X - reach; x <= middle.X + reach; x++)
            {
                for (var y = middle.Y - reach; y <= middle.Y + reach; y++)
                {
                    for (var z = middle.Z - reach; z <= middle.Z + reach; z++)
                    {
                        FindInCell(x, y, z, centre, radius, found, distances);
                    }
                }
            }
        }

        private void FindInCell(
            int x, int y, int z, Vector3 centre, float radius, List<Node> found, List<float> distances)
        {
            var bucket = Bucket(x, y, z);
            for (var i = starts[bucket]; i < starts[bucket + 1]; i++)
            {
                var index = order[i];
                // Other cells may share the bucket.
                if (cells[index].X != x || cells[index].Y != y || cells[index].Z != z) continue;
                var dx = positions[index].x - centre.x;
                var dy = positions[index].y - centre.y;
                var dz = positions[index].z - centre.z;
                var squared = dx * dx + dy * dy + dz * dz;
                if (squared > radius * radius) continue;
                found.Add(nodes[index]);
                distances.Add((float)Math.Sqrt(squared));
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
            }
            var buckets = starts.Length - 1;
            while (buckets < 2 * count) buckets *= 2;
            if (buckets + 1 > starts.Length) starts = new int[buckets + 1];
            mask = buckets - 1;
        }
    }
}
