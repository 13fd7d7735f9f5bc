using System;

namespace UnityEngine
{
    /// A collider with the shape of a mesh. If it is convex, its shape is the convex hull of the mesh. Otherwise it consists of the triangles of the mesh,
    /// has no interior, and must be static or kinematic.
    public class MeshCollider : Collider
    {
        Mesh ownMesh;
        bool ownConvex;
        readonly CookedMesh cooked = new CookedMesh();
        int cookedVersion;
        Vector3 cookedScale;
        bool hasFailed; // with this version and scale

        public bool convex
        {
            get => this.Existing().ownConvex;
            set
            {
                if (convex == value) return;
                ownConvex = value;
                MeshChanged();
            }
        }

        /// As in Unity, assign the mesh again after changing its vertices.
        public Mesh sharedMesh
        {
            get => this.Existing().ownMesh;
            set
            {
                ownMesh = value;
                MeshChanged();
            }
        }

        internal override bool HasClosestPoint => ownConvex;

        void MeshChanged()
        {
            DropShape();
            cooked.Release();
            hasFailed = false;
            ShapeChanged();
        }

        internal override void Fit(Mesh mesh) => ownMesh = mesh;

        internal override bool Describe(Vector3 scale, ref Physx.Shape shape)
        {
            if (!ownMesh || ownMesh.vertexCount == 0) return false;
            if (!ownConvex && !(Body is null) && !Body.isKinematic)
                return Refuse("Non-convex MeshCollider with non-kinematic Rigidbody is no longer supported since Unity 5.\n"
                    + "If you want to use a non-convex mesh either make the Rigidbody kinematic or remove the Rigidbody component.");
            if (!ownMesh.HasOnlyTriangles) return Refuse($"The mesh '{ownMesh.name}' has lines, points or quads, which cannot be a collider.");
            if (!ownConvex && isTrigger) return Refuse("Triggers on concave MeshColliders are not supported.");
            var isStale = cookedVersion != ownMesh.Version || !cookedScale.Equals(scale);
            if (isStale || cooked.Handle == IntPtr.Zero && !hasFailed) Cook(scale);
            if (cooked.Handle == IntPtr.Zero) return false;
            shape.Geometry.Kind = Physx.Kind.Mesh;
            shape.Geometry.Mesh = cooked.Handle;
            shape.Pose = new Physx.Pose(Vector3.zero, Quaternion.identity);
            return true;
        }

        /// Converts the mesh to PhysX's format. The scale is applied to the vertices, so that any scale is possible, including mirrored and flat scales.
        void Cook(Vector3 scale)
        {
            var points = ownMesh.vertices;
            var indices = ownMesh.triangles;
            for (var index = 0; index < points.Length; index++) points[index] = Vector3.Scale(points[index], scale);
            if (scale.x * scale.y * scale.z < 0f)
                for (var index = 0; index + 2 < indices.Length; index += 3) (indices[index], indices[index + 1]) = (indices[index + 1], indices[index]);
            var problem = cooked.Cook(points, indices, ownConvex);
            cookedScale = scale;
            cookedVersion = ownMesh.Version;
            hasFailed = problem != null;
            if (hasFailed) Debug.LogError($"The mesh '{ownMesh.name}' of MeshCollider '{NameImpl}' cannot be a collider: {problem}", this);
        }

        internal override void Deactivate()
        {
            base.Deactivate();
            cooked.Release();
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (MeshCollider)original;
            ownMesh = other.ownMesh;
            ownConvex = other.ownConvex;
        }
    }
}
