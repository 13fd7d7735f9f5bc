namespace UnityEngine
{
    public struct RaycastHit
    {
        public Collider collider { get; internal set; }
        public Vector3 point { get; set; }
        public Vector3 normal { get; set; }
        public float distance { get; set; }
        public Rigidbody rigidbody => collider ? collider.attachedRigidbody : null;
        public Transform transform => rigidbody ? rigidbody.transform : collider ? collider.transform : null;
    }
}
