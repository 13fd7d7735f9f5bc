namespace UnityEngine
{
    public class CapsuleCollider : Collider
    {
        // Turn the shape's z axis to x, y or z.
        static readonly Quaternion[] Turns = { Quaternion.Euler(0f, 90f, 0f), Quaternion.Euler(-90f, 0f, 0f), Quaternion.identity };

        Vector3 ownCenter;
        float ownRadius = 0.5f;
        float ownHeight = 1f;
        int ownDirection = 1;

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

        /// With both caps; one below the diameter gives a sphere.
        public float height
        {
            get => ownHeight;
            set
            {
                ownHeight = value;
                ShapeChanged();
            }
        }

        /// 0, 1, 2: along x, y, z.
        public int direction
        {
            get => ownDirection;
            set
            {
                ownDirection = value;
                ShapeChanged();
            }
        }

        internal override Shape ScaledShape(Vector3 scale)
        {
            var radius = ownRadius * Mathf.Max(Mathf.Abs(scale[(ownDirection + 1) % 3]), Mathf.Abs(scale[(ownDirection + 2) % 3]));
            return new Shape
            {
                Center = Vector3.Scale(ownCenter, scale),
                Rotation = Turns[ownDirection],
                Half = new Vector3(0f, 0f, Mathf.Max(0f, ownHeight * Mathf.Abs(scale[ownDirection]) * 0.5f - radius)),
                Radius = radius,
            };
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
