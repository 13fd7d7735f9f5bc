namespace UnityEngine
{
    public class SphereCollider : Collider
    {
        Vector3 ownCenter;
        float ownRadius = 0.5f;

        public Vector3 center
        {
            get => ownCenter;
            set
            {
                ownCenter = value;
                ShapeChanged();
            }
        }

        public float radius
        {
            get => ownRadius;
            set
            {
                ownRadius = value;
                ShapeChanged();
            }
        }

        internal override Shape ScaledShape(Vector3 scale) => new Shape
        {
            Center = Vector3.Scale(ownCenter, scale),
            Rotation = Quaternion.identity,
            Radius = ownRadius * Mathf.Max(Mathf.Abs(scale.x), Mathf.Max(Mathf.Abs(scale.y), Mathf.Abs(scale.z))),
        };

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (SphereCollider)original;
            ownCenter = other.ownCenter;
            ownRadius = other.ownRadius;
        }
    }
}
