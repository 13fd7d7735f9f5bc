namespace UnityEngine
{
    public struct RaycastHit
    {
        internal RaycastHit(in Physx.Hit hit)
        {
            collider = PhysicsWorld.ColliderOf(hit.Shape);
            point = hit.Point;
            normal = hit.Normal;
            distance = hit.Distance;
            triangleIndex = hit.Triangle;
        }

        public Collider collider { get; internal set; }
        public Vector3 point { get; set; }
        public Vector3 normal { get; set; }
        public float distance { get; set; }
        /// Index of the triangle if the collider is a concave mesh; otherwise -1.
        public int triangleIndex { get; }
        public Rigidbody rigidbody => collider ? collider.attachedRigidbody : null;
        public Transform transform => rigidbody ? rigidbody.transform : collider ? collider.transform : null;
    }
}
