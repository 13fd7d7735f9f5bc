namespace UnityEngine
{
    /// ODE's world knows it as the box around its mesh.
    public class MeshCollider : Collider
    {
        Mesh ownMesh;

        public bool convex { get; set; }

        public Mesh sharedMesh
        {
            get => ownMesh;
            set
            {
                ownMesh = value;
                ShapeChanged();
            }
        }

        internal override bool HasClosestPoint => convex;

        internal override Shape ScaledShape(Vector3 scale)
        {
            var box = ownMesh ? ownMesh.bounds : default;
            var size = Vector3.Scale(box.size, scale);
            return new Shape
            {
                Center = Vector3.Scale(box.center, scale),
                Rotation = Quaternion.identity,
                Half = 0.5f * new Vector3(Mathf.Abs(size.x), Mathf.Abs(size.y), Mathf.Abs(size.z)),
            };
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (MeshCollider)original;
            ownMesh = other.ownMesh;
            convex = other.convex;
        }
    }
}
