using System;
using System.Collections.Generic;
using UnityEngine.Rendering;

namespace UnityEngine
{
    public enum MeshTopology
    {
        Triangles = 0,
        Quads = 2,
        Lines = 3,
        LineStrip = 4,
        Points = 5,
    }

    public sealed class Mesh : Object
    {
        readonly List<Vector3> ownVertices = new List<Vector3>();
        Vector3[] ownNormals = Array.Empty<Vector3>();
        readonly List<Color> ownColors = new List<Color>();
        Bounds ownBounds;
        IndexFormat format;
        readonly List<List<int>> submeshes = new List<List<int>> { new List<int>() };

        /// Number of times that vertices or triangles were changed.
        internal int Version { get; private set; }

        public IndexFormat indexFormat { get => this.Existing().format; set => this.Existing().format = value; }
        public Bounds bounds { get => this.Existing().ownBounds; set => this.Existing().ownBounds = value; }
        public int vertexCount => this.Existing().ownVertices.Count;

        public int subMeshCount
        {
            get => this.Existing().submeshes.Count;
            set
            {
                ThrowIfDestroyed();
                while (submeshes.Count < value) submeshes.Add(new List<int>());
                submeshes.RemoveRange(value, submeshes.Count - value);
                Version++;
            }
        }

        public Vector3[] vertices { get => this.Existing().ownVertices.ToArray(); set => SetVertices(value); }

        public int[] triangles
        {
            get
            {
                var all = new List<int>();
                foreach (var submesh in this.Existing().submeshes) all.AddRange(submesh);
                return all.ToArray();
            }
            set
            {
                subMeshCount = 1;
                SetTriangles(value, 0);
            }
        }

        public Vector3[] normals { get => (Vector3[])this.Existing().ownNormals.Clone(); set => this.Existing().ownNormals = (Vector3[])value.Clone(); }

        public Color[] colors
        {
            get => this.Existing().ownColors.ToArray();
            set => SetColors(value);
        }

        public void GetVertices(List<Vector3> vertices)
        {
            vertices.Clear();
            vertices.AddRange(this.Existing().ownVertices);
        }

        public void SetVertices(List<Vector3> inVertices) => Replace(ownVertices, inVertices);
        public void SetVertices(Vector3[] inVertices) => Replace(ownVertices, inVertices);

        public void SetVertices(List<Vector3> inVertices, int start, int length) => Replace(ownVertices, inVertices.GetRange(start, length));

        public void SetVertices(Vector3[] inVertices, int start, int length) => Replace(ownVertices, new ArraySegment<Vector3>(inVertices, start, length));

        public void SetColors(List<Color> inColors) => Replace(ownColors, inColors);
        public void SetColors(Color[] inColors) => Replace(ownColors, inColors);
        public void SetTriangles(int[] triangles, int submesh) => SetIndices(triangles, MeshTopology.Triangles, submesh);
        public void SetTriangles(List<int> triangles, int submesh) => SetIndices(triangles, MeshTopology.Triangles, submesh);

        public void SetIndices(int[] indices, MeshTopology topology, int submesh) => SetIndices(new List<int>(indices), topology, submesh);

        public void SetIndices(List<int> indices, MeshTopology topology, int submesh, bool calculateBounds = true, int baseVertex = 0)
        {
            if (submesh < 0 || submesh >= subMeshCount)
            {
                Debug.LogError($"Failed setting indices of mesh '{name}': submesh {submesh} does not exist. Set subMeshCount first.", this);
                return;
            }
            Replace(submeshes[submesh], indices.ConvertAll(index => index + baseVertex));
            if (calculateBounds) RecalculateBounds();
        }

        void Replace<T>(List<T> target, IEnumerable<T> values)
        {
            ThrowIfDestroyed();
            target.Clear();
            target.AddRange(values);
            Version++;
        }

        public void Clear() => Clear(true);

        public void Clear(bool keepVertexLayout)
        {
            subMeshCount = 1;
            submeshes[0].Clear();
            ownVertices.Clear();
            ownNormals = Array.Empty<Vector3>();
            ownColors.Clear();
            Version++;
        }

        internal Mesh Copy(string name)
        {
            var copy = new Mesh { name = name, indexFormat = indexFormat, bounds = bounds, vertices = vertices, normals = normals, colors = colors };
            copy.submeshes.Clear();
            foreach (var submesh in submeshes) copy.submeshes.Add(new List<int>(submesh));
            return copy;
        }

        public void RecalculateBounds()
        {
            if (this.Existing().ownVertices.Count == 0) return;
            Vector3 least = ownVertices[0], most = ownVertices[0];
            foreach (var vertex in ownVertices)
            {
                least = Vector3.Min(least, vertex);
                most = Vector3.Max(most, vertex);
            }
            bounds = new Bounds((least + most) * 0.5f, most - least);
        }

        public void RecalculateNormals() => ThrowIfDestroyed();
        public void MarkDynamic() => ThrowIfDestroyed();
        public void UploadMeshData(bool markNoLongerReadable) => ThrowIfDestroyed();

        static readonly Mesh[] Primitives = new Mesh[Enum.GetValues(typeof(PrimitiveType)).Length];

        internal static void ResetState() => Array.Clear(Primitives, 0, Primitives.Length);

        /// Returns the mesh that all primitives of a type share.
        internal static Mesh Primitive(PrimitiveType type) => Primitives[(int)type] = Primitives[(int)type] ?? PrimitiveMesh.Create(type);
    }
}
