namespace UnityEngine
{
    public class SphereCollider : Collider
    {
        Vector3 ownCenter;
        float ownRadius = 0.5f;

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

        internal override void Fit(Mesh mesh)
        {
            var half = mesh.bounds.extents;
            ownCenter = mesh.bounds.center;
            ownRadius = Mathf.Max(half.x, Mathf.Max(half.y, half.z));
        }

        internal override bool Describe(Vector3 scale, ref Physx.Shape shape)
        {
            shape.Geometry.Kind = Physx.Kind.Sphere;
            shape.Geometry.Radius = Mathf.Abs(ownRadius) * Mathf.Max(Mathf.Abs(scale.x), Mathf.Max(Mathf.Abs(scale.y), Mathf.Abs(scale.z)));
            shape.Pose = new Physx.Pose(ScaledCenter(ownCenter, scale), Quaternion.identity);
            return true;
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (SphereCollider)original;
            ownCenter = other.ownCenter;
            ownRadius = other.ownRadius;
        }
    }
}
