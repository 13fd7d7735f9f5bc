namespace UnityEngine
{
    public class BoxCollider : Collider
    {
        // Thinner boxes fall through the solver; this is far below anything that a scene means.
        const float LeastHalf = 0.005f;

        Vector3 ownCenter;
        Vector3 ownSize = Vector3.one;

        public Vector3 center
        {
            get => ownCenter;
            set
            {
                ownCenter = value;
                ShapeChanged();
            }
        }

        public Vector3 size
        {
            get => ownSize;
            set
            {
                ownSize = value;
                ShapeChanged();
            }
        }

        internal override Shape ScaledShape(Vector3 scale) => new Shape
        {
            Center = Vector3.Scale(ownCenter, scale),
            Rotation = Quaternion.identity,
            Half = new Vector3(Half(ownSize.x * scale.x), Half(ownSize.y * scale.y), Half(ownSize.z * scale.z)),
        };

        static float Half(float size) => Mathf.Max(LeastHalf, Mathf.Abs(size) * 0.5f);

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (BoxCollider)original;
            ownCenter = other.ownCenter;
            ownSize = other.ownSize;
        }
    }
}
