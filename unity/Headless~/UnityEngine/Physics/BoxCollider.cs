namespace UnityEngine
{
    public class BoxCollider : Collider
    {
        Vector3 ownCenter;
        Vector3 ownSize = Vector3.one;

        public Vector3 center
        {
            get => this.Existing().ownCenter;
            set
            {
                ownCenter = value;
                ShapeChanged();
            }
        }

        public Vector3 size
        {
            get => this.Existing().ownSize;
            set
            {
                ownSize = value;
                ShapeChanged();
            }
        }

        internal override void Fit(Mesh mesh)
        {
            ownCenter = mesh.bounds.center;
            ownSize = mesh.bounds.size;
        }

        internal override bool Describe(Vector3 scale, ref Physx.Shape shape)
        {
            var half = Vector3.Scale(ownSize, scale) * 0.5f;
            shape.Geometry.Kind = Physx.Kind.Box;
            shape.Geometry.Half = new Vector3(Mathf.Abs(half.x), Mathf.Abs(half.y), Mathf.Abs(half.z));
            shape.Pose = new Physx.Pose(ScaledCenter(ownCenter, scale), Quaternion.identity);
            return true;
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (BoxCollider)original;
            ownCenter = other.ownCenter;
            ownSize = other.ownSize;
        }
    }
}
