using System.Collections.Generic;

namespace UnityEngine
{
    /// Finds colliders by place: square columns over the x-z plane, hashed. Rebuilt whole, which for ten thousand bodies costs less than a step.
    sealed class ColumnGrid
    {
        const float Side = 2f; // metres; bodies of swarms and neighbourhoods of a few metres span few columns
        const int MostColumns = 64; // what spans more (floors, long walls) is kept aside and looked at by every query

        readonly List<Collider> wide = new List<Collider>();
        Collider[] entries = new Collider[64];
        int[] starts = new int[1];
        Collider[] found = new Collider[64];
        int mask, stamp;
        float leastX, leastZ, mostX, mostZ;

        /// The result of the latest query, in a fixed order for the same world.
        public Collider[] Found => found;

        public void Build(List<Collider> colliders)
        {
            wide.Clear();
            leastX = leastZ = float.PositiveInfinity;
            mostX = mostZ = float.NegativeInfinity;
            var total = 0;
            foreach (var collider in colliders)
            {
                var columns = Columns(collider);
                if (columns <= MostColumns) total += columns;
                else wide.Add(collider);
            }
            var buckets = Mathf.NextPowerOfTwo(Mathf.Max(256, 2 * total));
            mask = buckets - 1;
            if (starts.Length < buckets + 2) starts = new int[buckets + 2];
            else System.Array.Clear(starts, 0, starts.Length);
            if (entries.Length < total) entries = new Collider[Mathf.NextPowerOfTwo(total)];
            if (found.Length < colliders.Count) found = new Collider[Mathf.NextPowerOfTwo(colliders.Count)];
            foreach (var collider in colliders) Visit(collider, false);
            for (var bucket = 2; bucket < buckets + 2; bucket++) starts[bucket] += starts[bucket - 1];
            foreach (var collider in colliders) Visit(collider, true);
        }

        static int Columns(Collider collider)
        {
            float x = (collider.Max.x - collider.Min.x) / Side, z = (collider.Max.z - collider.Min.z) / Side;
            return x * z > MostColumns || !(x * z < MostColumns) ? int.MaxValue
                : (Cell(collider.Max.x) - Cell(collider.Min.x) + 1) * (Cell(collider.Max.z) - Cell(collider.Min.z) + 1);
        }

        /// Counts per bucket in the first pass (at bucket + 2); in the second, starts[bucket + 1] runs from the bucket's start to its end.
        void Visit(Collider collider, bool store)
        {
            if (Columns(collider) > MostColumns) return;
            int x0 = Cell(collider.Min.x), x1 = Cell(collider.Max.x), z0 = Cell(collider.Min.z), z1 = Cell(collider.Max.z);
            for (var x = x0; x <= x1; x++)
                for (var z = z0; z <= z1; z++)
                {
                    var bucket = Bucket(x, z);
                    if (store) entries[starts[bucket + 1]++] = collider;
                    else starts[bucket + 2]++;
                }
            if (store) return;
            leastX = Mathf.Min(leastX, collider.Min.x);
            leastZ = Mathf.Min(leastZ, collider.Min.z);
            mostX = Mathf.Max(mostX, collider.Max.x);
            mostZ = Mathf.Max(mostZ, collider.Max.z);
        }

        static int Cell(float coordinate) => Mathf.FloorToInt(coordinate / Side);
        int Bucket(int x, int z) => (x * 73856093 ^ z * 19349663) & mask;

        /// Colliders whose upright boxes meet this one, each once. Returns their number; they are in `Found`.
        public int InBox(Vector3 min, Vector3 max)
        {
            stamp++;
            var count = 0;
            foreach (var collider in wide)
                if (Meets(collider, min, max)) found[count++] = collider;
            min.x = Mathf.Max(min.x, leastX);
            min.z = Mathf.Max(min.z, leastZ);
            max.x = Mathf.Min(max.x, mostX);
            max.z = Mathf.Min(max.z, mostZ);
            if (min.x > max.x || min.z > max.z) return count;
            int x0 = Cell(min.x), x1 = Cell(max.x), z0 = Cell(min.z), z1 = Cell(max.z);
            for (var x = x0; x <= x1; x++)
                for (var z = z0; z <= z1; z++)
                {
                    var bucket = Bucket(x, z);
                    for (var index = starts[bucket]; index < starts[bucket + 1]; index++)
                    {
                        var collider = entries[index];
                        if (collider.QueryStamp == stamp) continue;
                        collider.QueryStamp = stamp;
                        if (Meets(collider, min, max)) found[count++] = collider;
                    }
                }
            return count;
        }

        static bool Meets(Collider collider, Vector3 min, Vector3 max) =>
            collider.Min.x <= max.x && collider.Max.x >= min.x && collider.Min.z <= max.z && collider.Max.z >= min.z && collider.Min.y <= max.y && collider.Max.y >= min.y;

        /// Colliders in the columns under a ray (unit direction), each once.
        public int AlongRay(Vector3 origin, Vector3 direction, float maxDistance)
        {
            stamp++;
            var count = 0;
            foreach (var collider in wide) found[count++] = collider;
            const float farthest = 1e9f;
            float from = 0f, to = Mathf.Min(maxDistance, farthest);
            if (leastX > mostX) return count;
            if (!Clip(origin.x, direction.x, leastX, mostX, ref from, ref to) || !Clip(origin.z, direction.z, leastZ, mostZ, ref from, ref to)) return count;
            // Walk strip by strip along x; in each, all columns between the ray's z at both ends.
            float startX = origin.x + direction.x * from, endX = origin.x + direction.x * to;
            int x0 = Cell(Mathf.Min(startX, endX)), x1 = Cell(Mathf.Max(startX, endX));
            for (var x = x0; x <= x1; x++)
            {
                float enter = from, leave = to;
                if (x0 != x1 && !Clip(origin.x, direction.x, x * Side, (x + 1) * Side, ref enter, ref leave)) continue;
                float a = origin.z + direction.z * enter, b = origin.z + direction.z * leave;
                const float rounding = 1e-3f; // a ray along a border belongs to both sides
                int z0 = Cell(Mathf.Min(a, b) - rounding), z1 = Cell(Mathf.Max(a, b) + rounding);
                for (var z = z0; z <= z1; z++)
                {
                    var bucket = Bucket(x, z);
                    for (var index = starts[bucket]; index < starts[bucket + 1]; index++)
                    {
                        var collider = entries[index];
                        if (collider.QueryStamp == stamp) continue;
                        collider.QueryStamp = stamp;
                        found[count++] = collider;
                    }
                }
            }
            return count;
        }

        static bool Clip(float origin, float direction, float min, float max, ref float from, ref float to)
        {
            if (direction == 0f) return origin >= min && origin <= max;
            float a = (min - origin) / direction, b = (max - origin) / direction;
            from = Mathf.Max(from, Mathf.Min(a, b));
            to = Mathf.Min(to, Mathf.Max(a, b));
            return from <= to;
        }
    }
}
