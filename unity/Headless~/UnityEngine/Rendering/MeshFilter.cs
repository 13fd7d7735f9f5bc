namespace UnityEngine
{
    [DisallowMultipleComponent]
    public sealed class MeshFilter : Component
    {
        Mesh shared;
        Mesh own;

        public Mesh sharedMesh { get => this.Existing().shared; set => this.Existing().shared = value; }

        /// This filter's copy of the shared mesh, created on the first access. Without a shared mesh it is a new, empty mesh.
        public Mesh mesh
        {
            get
            {
                if (!sharedMesh) mesh = new Mesh();
                else if (own != shared) mesh = shared.Copy(shared.name + " Instance");
                return own;
            }
            set => sharedMesh = own = value;
        }

        internal override void CopyFrom(Component original) => shared = ((MeshFilter)original).shared;
    }
}
