using System;
using System.Collections.Generic;

namespace UnityEngine
{
    /// Finds colliders by place. Square cells over the x-z plane on several levels: a collider lies, with its centre, in one cell of the level
    /// whose side is not below its size, and queries look half the level's largest collider further. Built anew, on the next use, whenever
    /// something moved.
    sealed class ColliderGrid
    {
        const int Levels = 12; // sides of 1, 2, 4 ... 2048 m; what is larger lies on the last level too
        const float Farthest = 1e9f; // metres: ends rays, and keeps cell numbers within an int

        struct Slot
        {
            public Vector3 Min, Max, Center;
            public float Radius; // of a sphere; negative for other shapes
            public int Level, X, Z;
        }

        struct Level
        {
            public float Side, Margin; // Margin: largest half size along x or z
            public int Count;
        }

        readonly Level[] levels = new Level[Levels];
        Collider[] members = new Collider[64];
        Slot[] slots = new Slot[64];
        int[] entries = new int[64]; // slots, bucket by bucket
        int[] starts = new int[1];
        int[] found = new int[64];
        int size, mask;
        Vector3 least, most; // around all centres

        /// The n-th collider of the latest query. Queries give the same order for the same world.
        public Collider Found(int n) => members[found[n]];

        public void Build(List<Collider> colliders)
        {
            Array.Clear(members, 0, size);
            size = colliders.Count;
            if (members.Length < size)
            {
                var capacity = Mathf.NextPowerOfTwo(size);
                members = new Collider[capacity];
                slots = new Slot[capacity];
                entries = new int[capacity];
                found = new int[capacity];
            }
            for (var level = 0; level < Levels; level++) levels[level] = new Level { Side = 1 << level };
            least = Vector3.positiveInfinity;
            most = Vector3.negativeInfinity;
            var buckets = Mathf.NextPowerOfTwo(Mathf.Max(64, 2 * size));
            mask = buckets - 1;
            if (starts.Length < buckets + 2) starts = new int[buckets + 2];
            else Array.Clear(starts, 0, starts.Length);
            for (var index = 0; index < size; index++)
            {
                var collider = members[index] = colliders[index];
                ref var slot = ref slots[index];
                Fill(ref slot, collider);
                starts[Bucket(slot.Level, slot.X, slot.Z) + 2]++;
            }
            for (var bucket = 2; bucket < buckets + 2; bucket++) starts[bucket] += starts[bucket - 1];
            // starts[b + 1] now runs from the start of bucket b to its end.
            for (var index = 0; index < size; index++)
            {
                ref var slot = ref slots[index];
                entries[starts[Bucket(slot.Level, slot.X, slot.Z) + 1]++] = index;
            }
        }

        void Fill(ref Slot slot, Collider collider)
        {
            slot.Min = collider.Min;
            slot.Max = collider.Max;
            slot.Center = collider.World.Center;
            slot.Radius = collider.World.IsSphere ? collider.World.Radius : -1f;
            var extent = Mathf.Max(slot.Max.x - slot.Min.x, slot.Max.z - slot.Min.z);
            slot.Level = 0;
            while (slot.Level < Levels - 1 && levels[slot.Level].Side < extent) slot.Level++;
            ref var level = ref levels[slot.Level];
            level.Margin = Mathf.Max(level.Margin, extent * 0.5f);
            level.Count++;
            slot.X = Cell(slot.Center.x, level.Side);
            slot.Z = Cell(slot.Center.z, level.Side);
            least = Vector3.Min(least, slot.Center);
            most = Vector3.Max(most, slot.Center);
        }

        static int Cell(float coordinate, float side) => (int)Math.Floor(Mathf.Clamp(coordinate, -Farthest, Farthest) / side);
        int Bucket(int level, int x, int z) => (x * 73856093 ^ z * 19349663 ^ level * 83492791) & mask;

        /// Colliders whose upright boxes meet this one. Returns their number.
        public int InBox(Vector3 min, Vector3 max)
        {
            var count = 0;
            for (var index = 0; index < Levels; index++)
            {
                ref var level = ref levels[index];
                if (level.Count == 0) continue;
                int x0 = Cell(Mathf.Max(min.x - level.Margin, least.x), level.Side), x1 = Cell(Mathf.Min(max.x + level.Margin, most.x), level.Side);
                int z0 = Cell(Mathf.Max(min.z - level.Margin, least.z), level.Side), z1 = Cell(Mathf.Min(max.z + level.Margin, most.z), level.Side);
                for (var x = x0; x <= x1; x++)
                    for (var z = z0; z <= z1; z++) count = InCell(index, x, z, min, max, count);
            }
            return count;
        }

        int InCell(int level, int x, int z, Vector3 min, Vector3 max, int count)
        {
            var bucket = Bucket(level, x, z);
            var end = starts[bucket + 1];
            for (var entry = starts[bucket]; entry < end; entry++)
            {
                var index = entries[entry];
                ref var slot = ref slots[index];
                if (slot.Min.x <= max.x && slot.Max.x >= min.x && slot.Min.z <= max.z && slot.Max.z >= min.z && slot.Min.y <= max.y && slot.Max.y >= min.y
                    && slot.X == x && slot.Z == z && slot.Level == level)
                    found[count++] = index;
            }
            return count;
        }

        /// Colliders that touch a sphere. Returns their number.
        public int InSphere(Vector3 center, float radius)
        {
            var reach = new Vector3(radius, radius, radius);
            int candidates = InBox(center - reach, center + reach), count = 0;
            for (var candidate = 0; candidate < candidates; candidate++)
            {
                var index = found[candidate];
                ref var slot = ref slots[index];
                if (slot.Radius >= 0f)
                {
                    float x = center.x - slot.Center.x, y = center.y - slot.Center.y, z = center.z - slot.Center.z, limit = radius + slot.Radius;
                    if (x * x + y * y + z * z > limit * limit) continue;
                }
                else if (!members[index].World.TouchesSphere(center, radius)) continue;
                found[count++] = index;
            }
            return count;
        }

        /// Colliders that a ray (unit direction) may hit. Returns their number.
        public int AlongRay(Vector3 origin, Vector3 direction, float maxDistance)
        {
            var count = 0;
            for (var index = 0; index < Levels; index++)
            {
                ref var level = ref levels[index];
                if (level.Count == 0) continue;
                float margin = level.Margin, from = 0f, to = Mathf.Min(maxDistance, Farthest);
                if (!Clip(origin.x, direction.x, least.x - margin, most.x + margin, ref from, ref to)
                    || !Clip(origin.z, direction.z, least.z - margin, most.z + margin, ref from, ref to)) continue;
                // Strip by strip along x; in each, the cells between the ray's z where it enters and leaves the strip's reach.
                float startX = origin.x + direction.x * from, endX = origin.x + direction.x * to;
                int x0 = Cell(Mathf.Min(startX, endX) - margin, level.Side), x1 = Cell(Mathf.Max(startX, endX) + margin, level.Side);
                for (var x = x0; x <= x1; x++)
                {
                    float enter = from, leave = to;
                    if (!Clip(origin.x, direction.x, x * level.Side - margin, (x + 1) * level.Side + margin, ref enter, ref leave)) continue;
                    float a = origin.z + direction.z * enter, b = origin.z + direction.z * leave;
                    int z0 = Cell(Mathf.Min(a, b) - margin, level.Side), z1 = Cell(Mathf.Max(a, b) + margin, level.Side);
                    for (var z = z0; z <= z1; z++) count = InCell(index, x, z, Vector3.negativeInfinity, Vector3.positiveInfinity, count);
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
