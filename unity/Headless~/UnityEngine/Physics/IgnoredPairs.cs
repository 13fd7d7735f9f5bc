using System.Collections.Generic;

namespace UnityEngine
{
    /// The pairs of layers and the pairs of colliders that do not collide.
    sealed class IgnoredPairs
    {
        readonly int[] layers = new int[32]; // bit j of row i: layers i and j
        readonly HashSet<ulong> colliders = new HashSet<ulong>();

        static ulong Key(Collider a, Collider b) => a.id < b.id ? (ulong)a.id << 32 | (uint)b.id : (ulong)b.id << 32 | (uint)a.id;

        public void Set(Collider a, Collider b, bool ignore)
        {
            if (ignore ? colliders.Add(Key(a, b)) : colliders.Remove(Key(a, b)))
                Physx.physics_ignore_pair(PhysicsWorld.Handle, (uint)a.id, (uint)b.id, ignore ? 1 : 0);
        }

        public bool Has(Collider a, Collider b) => colliders.Contains(Key(a, b));

        public void SetLayers(int a, int b, bool ignore)
        {
            layers[a] = ignore ? layers[a] | 1 << b : layers[a] & ~(1 << b);
            layers[b] = ignore ? layers[b] | 1 << a : layers[b] & ~(1 << a);
            SendTo(PhysicsWorld.Handle);
        }

        public bool HasLayers(int a, int b) => (layers[a] & 1 << b) != 0;

        unsafe void SendTo(System.IntPtr world)
        {
            fixed (int* rows = layers) Physx.physics_ignore_layers(world, rows);
        }

        /// Clears all pairs. The caller also destroys PhysX's world, which has its own copy.
        public void Clear()
        {
            System.Array.Clear(layers, 0, layers.Length);
            colliders.Clear();
        }
    }
}
