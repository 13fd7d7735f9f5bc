using System;
using System.Collections.Generic;

namespace UnityEngine
{
    /// Permutes the orders that Unity does not specify, if `Loop.OrderSeed` is set.
    static class Orders
    {
        static System.Random random;

        internal static int Seed { get; private set; }

        internal static bool IsPermuted => random != null;

        internal static void Reset(int seed)
        {
            Seed = seed;
            random = seed == 0 ? null : new System.Random(seed);
        }

        internal static int Next() => random.Next();

        internal static bool Swaps() => random != null && random.Next(2) == 0;

        internal static void Shuffle<T>(List<T> items)
        {
            if (random == null) return;
            for (var left = items.Count; left > 1; left--)
            {
                var other = random.Next(left);
                (items[left - 1], items[other]) = (items[other], items[left - 1]);
            }
        }

        internal static void Shuffle<T>(T[] items, int count)
        {
            if (random == null) return;
            for (var left = count; left > 1; left--)
            {
                var other = random.Next(left);
                (items[left - 1], items[other]) = (items[other], items[left - 1]);
            }
        }
    }
}
