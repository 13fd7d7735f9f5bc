using System.Collections.Generic;

namespace UnityEngine
{
    /// Which pairs of layers and of single colliders pass through each other.
    sealed class IgnoredPairs
    {
        readonly int[] layers = new int[32]; // bit j of row i: layers i and j
        readonly HashSet<ulong> colliders = new HashSet<ulong>();

        /// One number for a pair, whatever its order. The odd factor keeps it unique and spreads the hash codes, which for plain pairs of near
        /// ids would nearly all be the same.
        public static ulong Key(Collider a, Collider b) =>
            (a.id < b.id ? (ulong)a.id << 32 | (uint)b.id : (ulong)b.id << 32 | (uint)a.id) * 0x9E3779B97F4A7C15UL;

        public void Set(Collider a, Collider b, bool ignore)
        {
            if (ignore) colliders.Add(Key(a, b));
            else colliders.Remove(Key(a, b));
        }

        public bool Has(Collider a, Collider b) => colliders.Contains(Key(a, b));

        public void SetLayers(int a, int b, bool ignore)
        {
            layers[a] = ignore ? layers[a] | 1 << b : layers[a] & ~(1 << b);
            layers[b] = ignore ? layers[b] | 1 << a : layers[b] & ~(1 << a);
        }

        public bool HasLayers(int a, int b) => (layers[a] & 1 << b) != 0;

        public bool Contains(Collider a, Collider b) => HasLayers(a.owner.layer, b.owner.layer) || colliders.Count > 0 && Has(a, b);

        public void Clear()
        {
            System.Array.Clear(layers, 0, layers.Length);
            colliders.Clear();
        }
    }
}
