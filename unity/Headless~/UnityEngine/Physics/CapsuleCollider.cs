using System;

namespace UnityEngine
{
    public class CapsuleCollider : Collider
    {
        // Rotations of PhysX's capsule, whose axis is x, to the axes x, y and z.
        static readonly Quaternion[] Turns = { Quaternion.identity, Quaternion.Euler(0f, 0f, 90f), Quaternion.Euler(0f, -90f, 0f) };

        Vector3 ownCenter;
        float ownRadius = 0.5f;
        float ownHeight = 1f;
        int ownDirection = 1;

        public Vector3 center
        {
            get => this.Existing().ownCenter;
            set
            {
                ownCenter = value;
                ShapeChanged();
            }
        }

        public float radius
        {
            get => this.Existing().ownRadius;
            set
            {
                ownRadius = value;
                ShapeChanged();
            }
        }

        /// Height including both caps. If it is less than the diameter, the shape is nearly a sphere.
        public float height
        {
            get => this.Existing().ownHeight;
            set
            {
                ownHeight = value;
                ShapeChanged();
            }
        }

        /// Axis of the capsule: 0, 1, 2 for x, y, z.
        public int direction
        {
            get => this.Existing().ownDirection;
            set
            {
                if (value < 0 || value > 2)
                    throw new ArgumentOutOfRangeException(nameof(direction), value, "A capsule's direction is 0, 1 or 2: along x, y or z.");
                ownDirection = value;
                ShapeChanged();
            }
        }

        internal override void Fit(Mesh mesh)
        {
            var size = mesh.bounds.size;
            ownCenter = mesh.bounds.center;
            ownRadius = Mathf.Max(size.x, size.z) * 0.5f;
            ownHeight = size.y;
        }

        internal override bool Describe(Vector3 scale, ref Physx.Shape shape)
        {
            var wide = Mathf.Max(Mathf.Abs(scale[(ownDirection + 1) % 3]), Mathf.Abs(scale[(ownDirection + 2) % 3]));
            var scaledRadius = Mathf.Abs(ownRadius) * wide;
            var halfLength = Mathf.Max(0f, Mathf.Abs(ownHeight * scale[ownDirection]) * 0.5f - scaledRadius);
            shape.Geometry.Kind = Physx.Kind.Capsule;
            shape.Geometry.Radius = scaledRadius;
            shape.Geometry.Half = new Vector3(halfLength, 0f, 0f);
            shape.Pose = new Physx.Pose(ScaledCenter(ownCenter, scale), Turns[ownDirection]);
            return true;
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (CapsuleCollider)original;
            ownCenter = other.ownCenter;
            ownRadius = other.ownRadius;
            ownHeight = other.ownHeight;
            ownDirection = other.ownDirection;
        }
    }
}
