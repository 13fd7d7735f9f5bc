using System;

namespace UnityEngine
{
    /// Marsaglia's xorshift128. Its numbers differ from Unity's numbers for the same seed.
    public static class Random
    {
        public struct State
        {
            internal uint s0, s1, s2, s3;
        }

        static State generator;

        static Random() => InitState(0);

        public static State state { get => generator; set => generator = value; }

        public static void InitState(int seed)
        {
            generator.s0 = (uint)seed;
            generator.s1 = generator.s0 * 1664525u + 1013904223u;
            generator.s2 = generator.s1 * 1664525u + 1013904223u;
            generator.s3 = generator.s2 * 1664525u + 1013904223u;
            for (var warmUp = 0; warmUp < 16; warmUp++) Next();
        }

        static uint Next()
        {
            Construction.Check(nameof(Random));
            var t = generator.s0 ^ (generator.s0 << 11);
            generator.s0 = generator.s1;
            generator.s1 = generator.s2;
            generator.s2 = generator.s3;
            return generator.s3 = generator.s3 ^ (generator.s3 >> 19) ^ t ^ (t >> 8);
        }

        /// A random number from 0 to 1, both inclusive.
        public static float value => (Next() >> 8) / 16777215f;

        public static float Range(float minInclusive, float maxInclusive) => minInclusive + (maxInclusive - minInclusive) * value;

        public static int Range(int minInclusive, int maxExclusive)
        {
            if (minInclusive == maxExclusive) return minInclusive;
            var span = (uint)((long)Math.Max(minInclusive, maxExclusive) - Math.Min(minInclusive, maxExclusive));
            return (int)(Math.Min(minInclusive, maxExclusive) + (long)(((ulong)Next() * span) >> 32));
        }

        public static Vector3 insideUnitSphere => onUnitSphere * Mathf.Pow(value, 1f / 3f);

        public static Vector2 insideUnitCircle
        {
            get
            {
                float angle = value * 2f * Mathf.PI, radius = Mathf.Sqrt(value);
                return new Vector2(Mathf.Cos(angle), Mathf.Sin(angle)) * radius;
            }
        }

        public static Vector3 onUnitSphere
        {
            get
            {
                float y = Range(-1f, 1f), angle = value * 2f * Mathf.PI, radius = Mathf.Sqrt(1f - y * y);
                return new Vector3(radius * Mathf.Cos(angle), y, radius * Mathf.Sin(angle));
            }
        }

        public static Quaternion rotationUniform
        {
            get
            {
                float turn = value * 2f * Mathf.PI, spin = value * 2f * Mathf.PI, share = value;
                float a = Mathf.Sqrt(1f - share), b = Mathf.Sqrt(share);
                return new Quaternion(a * Mathf.Sin(turn), a * Mathf.Cos(turn), b * Mathf.Sin(spin), b * Mathf.Cos(spin));
            }
        }

        /// Not uniform, as in Unity.
        public static Quaternion rotation => new Quaternion(Range(-1f, 1f), Range(-1f, 1f), Range(-1f, 1f), Range(-1f, 1f)).normalized;
    }
}
