using System.Collections.Generic;

namespace UnityEngine
{
    /// The pairs of layers and the pairs of colliders that do not collide.
    sealed class IgnoredPairs
    {
        readonly int[] layers = new int[32]; // bit j of row i: layers i and j
        readonly Dictionary<int, HashSet<int>> colliders = new Dictionary<int, HashSet<int>>(); // by one's id, the others' ids; both ways

        /// As in Unity, disabled and inactive colliders are in no pair.
        public void Set(Collider a, Collider b, bool ignore)
        {
            if (ignore && !(a.Registered && b.Registered))
                Debug.LogWarning($"Physics.IgnoreCollision has no effect: the collider of '{(a.Registered ? b : a).NameImpl}' is disabled or inactive.", a);
            else if (Has(a, b) != ignore) Change(a.id, b.id, a.Handle, b.Handle, ignore);
        }

        public bool Has(Collider a, Collider b) => colliders.TryGetValue(a.id, out var others) && others.Contains(b.id);

        /// Ends the pairs of a collider that has no shape any more.
        public void Remove(Collider collider)
        {
            if (!colliders.TryGetValue(collider.id, out var others)) return;
            foreach (var other in new List<int>(others)) Change(collider.id, other, Physx.None, Physx.None, false);
        }

        void Change(int a, int b, int shapeA, int shapeB, bool ignore)
        {
            Link(a, b, ignore);
            Link(b, a, ignore);
            Physx.physics_ignore_pair(PhysicsWorld.Handle, (uint)a, (uint)b, shapeA, shapeB, ignore ? 1 : 0);
        }

        void Link(int a, int b, bool ignore)
        {
            if (!colliders.TryGetValue(a, out var others)) colliders.Add(a, others = new HashSet<int>());
            if (ignore) others.Add(b);
            else if (others.Remove(b) && others.Count == 0) colliders.Remove(a);
        }

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
