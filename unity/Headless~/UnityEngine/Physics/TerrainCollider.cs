using System;
using UnityEngine.Headless;

namespace UnityEngine
{
    /// A collider with the surface of a height map, which has two triangles per square of samples. It uses the position of its object, but ignores the
    /// rotation and the scale.
    public class TerrainCollider : Collider
    {
        readonly CookedMesh cooked = new CookedMesh();
        TerrainData ownData;
        int cookedVersion;

        public TerrainData terrainData
        {
            get => this.Existing().ownData;
            set
            {
                ownData = value;
                DropShape();
                cooked.Release();
                ShapeChanged();
            }
        }

        internal override bool HasClosestPoint => false;

        internal override bool Describe(Vector3 scale, ref Physx.Shape shape)
        {
            if (!ownData) return false;
            if (!(Body is null) && !Body.isKinematic) return Refuse("A TerrainCollider cannot be part of a Rigidbody that is not kinematic.");
            if (isTrigger) return Refuse("A TerrainCollider cannot be a trigger.");
            if (cooked.Handle != IntPtr.Zero && cookedVersion != ownData.Version)
            {
                DropShape(); // a new mesh can have the address of the old one
                cooked.Release();
            }
            if (cooked.Handle == IntPtr.Zero) Cook();
            if (cooked.Handle == IntPtr.Zero) return false;
            shape.Geometry.Kind = Physx.Kind.Mesh;
            shape.Geometry.Mesh = cooked.Handle;
            shape.Pose = new Physx.Pose(Vector3.zero, Quaternion.Inverse(transform.rotation));
            return true;
        }

        void Cook()
        {
            var problem = cooked.Cook(TerrainMesh.Points(ownData, 1), TerrainMesh.Triangles(ownData.heightmapResolution), false);
            cookedVersion = ownData.Version;
            if (problem != null) Refuse($"The terrain cannot be a collider: {problem}");
        }

        internal override void Activate()
        {
            PhysicsWorld.Add(this);
            base.Activate();
        }

        internal override void Deactivate()
        {
            PhysicsWorld.Remove(this);
            base.Deactivate();
            cooked.Release();
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            ownData = ((TerrainCollider)original).ownData;
        }
    }
}
