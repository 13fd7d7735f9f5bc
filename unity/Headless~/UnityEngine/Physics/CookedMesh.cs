using System;

namespace UnityEngine
{
    /// A mesh in PhysX's format, as triangles or as a convex hull.
    sealed class CookedMesh
    {
        public IntPtr Handle { get; private set; }

        /// Cooks the mesh. Returns an error, or null.
        public unsafe string Cook(Vector3[] points, int[] indices, bool convex)
        {
            var former = Handle;
            fixed (Vector3* first = points)
            fixed (int* firstIndex = indices)
                Handle = Physx.physics_mesh_create(first, points.Length, firstIndex, indices.Length, convex ? 1 : 0);
            // Not earlier, because the new mesh could have the same address.
            if (former != IntPtr.Zero) Physx.physics_mesh_release(former);
            return Handle == IntPtr.Zero ? Physx.Error() : null;
        }

        public void Release()
        {
            if (Handle != IntPtr.Zero) Physx.physics_mesh_release(Handle);
            Handle = IntPtr.Zero;
        }
    }
}
