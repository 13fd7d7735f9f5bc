using System.Collections.Generic;
using UnityEngine.Rendering;

namespace UnityEngine
{
    /// Stores materials and property blocks, but draws nothing.
    public class Renderer : Component
    {
        readonly List<Material> ownMaterials = new List<Material>();
        MaterialPropertyBlock block;
        Bounds? ownBounds;
        Material own; // the copy for this renderer
        bool ownEnabled = true, takesShadows = true;
        ShadowCastingMode ownShadows = ShadowCastingMode.On;
        int order;

        List<Material> assigned => this.Existing().ownMaterials;
        public bool enabled { get => this.Existing().ownEnabled; set => this.Existing().ownEnabled = value; }

        public bool isVisible
        {
            get
            {
                ThrowIfDestroyed();
                return false;
            }
        }

        public ShadowCastingMode shadowCastingMode { get => this.Existing().ownShadows; set => this.Existing().ownShadows = value; }
        public bool receiveShadows { get => this.Existing().takesShadows; set => this.Existing().takesShadows = value; }
        public int sortingOrder { get => this.Existing().order; set => this.Existing().order = value; }

        public Bounds bounds
        {
            get
            {
                if (this.Existing().ownBounds.HasValue) return ownBounds.Value;
                var mesh = GetComponent<MeshFilter>()?.sharedMesh;
                if (!mesh) return new Bounds(transform.position, Vector3.zero);
                var matrix = transform.localToWorldMatrix;
                var extents = mesh.bounds.extents;
                Vector3 x = matrix.MultiplyVector(new Vector3(extents.x, 0f, 0f)), y = matrix.MultiplyVector(new Vector3(0f, extents.y, 0f)),
                    z = matrix.MultiplyVector(new Vector3(0f, 0f, extents.z));
                var reach = new Vector3(
                    Mathf.Abs(x.x) + Mathf.Abs(y.x) + Mathf.Abs(z.x), Mathf.Abs(x.y) + Mathf.Abs(y.y) + Mathf.Abs(z.y),
                        Mathf.Abs(x.z) + Mathf.Abs(y.z) + Mathf.Abs(z.z));
                return new Bounds(matrix.MultiplyPoint3x4(mesh.bounds.center), reach * 2f);
            }
            set => this.Existing().ownBounds = value;
        }

        public Material sharedMaterial
        {
            get => assigned.Count == 0 ? null : assigned[0];
            set
            {
                if (assigned.Count == 0) assigned.Add(value);
                else assigned[0] = value;
            }
        }

        /// This renderer's copy of the assigned material, created when it is read.
        public Material material
        {
            get
            {
                if (sharedMaterial && !ReferenceEquals(sharedMaterial, own))
                    assigned[0] = own = new Material(assigned[0]) { name = assigned[0].name + " (Instance)" };
                return sharedMaterial;
            }
            set => sharedMaterial = value;
        }

        public Material[] sharedMaterials
        {
            get => assigned.ToArray();
            set
            {
                assigned.Clear();
                assigned.AddRange(value);
            }
        }

        public void SetPropertyBlock(MaterialPropertyBlock properties)
        {
            ThrowIfDestroyed();
            if (properties == null) block = null;
            else (block = block ?? new MaterialPropertyBlock()).CopyFrom(properties);
        }

        public void GetPropertyBlock(MaterialPropertyBlock properties)
        {
            ThrowIfDestroyed();
            properties.Clear();
            if (block != null) properties.CopyFrom(block);
        }

        internal override void CopyFrom(Component original)
        {
            var other = (Renderer)original;
            enabled = other.enabled;
            shadowCastingMode = other.shadowCastingMode;
            receiveShadows = other.receiveShadows;
            sortingOrder = other.sortingOrder;
            assigned.AddRange(other.assigned);
        }
    }

    [DisallowMultipleComponent]
    public class MeshRenderer : Renderer { }
}

namespace UnityEngine.Rendering
{
    public enum ShadowCastingMode
    {
        Off = 0,
        On = 1,
        TwoSided = 2,
        ShadowsOnly = 3,
    }

    public enum IndexFormat
    {
        UInt16 = 0,
        UInt32 = 1,
    }
}
