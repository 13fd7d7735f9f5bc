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
        readonly List<Submesh> submeshes = new List<Submesh> { new Submesh() };

        sealed class Submesh
        {
            public readonly List<int> Indices = new List<int>();
            public MeshTopology Topology;
        }

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
                while (submeshes.Count < value) submeshes.Add(new Submesh());
                submeshes.RemoveRange(value, submeshes.Count - value);
                Version++;
            }
        }

        /// Whether all indices belong to triangles.
        internal bool HasOnlyTriangles => submeshes.TrueForAll(submesh => submesh.Topology == MeshTopology.Triangles || submesh.Indices.Count == 0);

        public Vector3[] vertices { get => this.Existing().ownVertices.ToArray(); set => SetVertices(value); }

        public int[] triangles
        {
            get
            {
                var all = new List<int>();
                foreach (var submesh in this.Existing().submeshes) all.AddRange(submesh.Indices);
                return all.ToArray();
            }
            set
            {
                if (subMeshCount == 0) subMeshCount = 1;
                if (ReplaceIndices(new List<int>(value), MeshTopology.Triangles, 0, true, 0)) subMeshCount = 1;
            }
        }

        public Vector3[] normals { get => (Vector3[])this.Existing().ownNormals.Clone(); set => SetNormals(value); }

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

        public void SetVertices(List<Vector3> inVertices) => ReplaceVertices(inVertices);
        public void SetVertices(Vector3[] inVertices) => ReplaceVertices(inVertices);

        public void SetVertices(List<Vector3> inVertices, int start, int length) => ReplaceVertices(inVertices.GetRange(start, length));

        public void SetVertices(Vector3[] inVertices, int start, int length) => ReplaceVertices(new ArraySegment<Vector3>(inVertices, start, length));

        void ReplaceVertices(ICollection<Vector3> vertices)
        {
            foreach (var submesh in submeshes)
                foreach (var index in submesh.Indices)
                {
                    if (index < vertices.Count) continue;
                    Reject("vertices", $"triangles use vertex {index}, but the array has {vertices.Count} vertices. First, remove the triangles.");
                    return;
                }
            Replace(ownVertices, vertices);
        }

        void SetNormals(Vector3[] normals)
        {
            if (HasOnePerVertex("normals", normals)) ownNormals = (Vector3[])normals.Clone();
        }

        public void SetColors(List<Color> inColors) => ReplaceColors(inColors);
        public void SetColors(Color[] inColors) => ReplaceColors(inColors);

        void ReplaceColors(ICollection<Color> colors)
        {
            if (HasOnePerVertex("colors", colors)) Replace(ownColors, colors);
        }

        bool HasOnePerVertex<T>(string kind, ICollection<T> values) => values.Count == vertexCount || values.Count == 0
            || Reject(kind, $"the mesh has {vertexCount} vertices, but the array has {values.Count} values.");

        /// As in Unity, arrays that do not fit the mesh are errors and change nothing.
        bool Reject(string kind, string reason)
        {
            Debug.LogError($"Failed setting {kind} of mesh '{name}': {reason}", this);
            return false;
        }

        public void SetTriangles(int[] triangles, int submesh) => SetIndices(triangles, MeshTopology.Triangles, submesh);
        public void SetTriangles(List<int> triangles, int submesh) => SetIndices(triangles, MeshTopology.Triangles, submesh);

        public void SetIndices(int[] indices, MeshTopology topology, int submesh) => SetIndices(new List<int>(indices), topology, submesh);

        public void SetIndices(List<int> indices, MeshTopology topology, int submesh, bool calculateBounds = true, int baseVertex = 0) =>
            ReplaceIndices(indices, topology, submesh, calculateBounds, baseVertex);

        bool ReplaceIndices(List<int> indices, MeshTopology topology, int submesh, bool calculateBounds, int baseVertex)
        {
            if (submesh < 0 || submesh >= subMeshCount) return Reject("indices", $"submesh {submesh} does not exist. Set subMeshCount first.");
            if (topology == MeshTopology.Triangles && indices.Count % 3 != 0)
                return Reject("triangles", $"{indices.Count} indices are not a multiple of 3.");
            foreach (var index in indices)
            {
                if (index + baseVertex >= 0 && index + baseVertex < vertexCount) continue;
                return Reject("indices", $"vertex {index + baseVertex} does not exist. The mesh has {vertexCount} vertices.");
            }
            submeshes[submesh].Topology = topology;
            Replace(submeshes[submesh].Indices, indices.ConvertAll(index => index + baseVertex));
            if (calculateBounds) RecalculateBounds();
            return true;
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
            submeshes[0].Indices.Clear();
            ownVertices.Clear();
            ownNormals = Array.Empty<Vector3>();
            ownColors.Clear();
            Version++;
        }

        internal Mesh Copy(string name)
        {
            var copy = new Mesh { name = name, indexFormat = indexFormat, bounds = bounds, vertices = vertices };
            // The number of normals and colours differs from that of vertices if vertices were replaced.
            copy.ownNormals = normals;
            copy.ownColors.AddRange(ownColors);
            copy.subMeshCount = subMeshCount;
            for (var index = 0; index < subMeshCount; index++)
            {
                copy.submeshes[index].Topology = submeshes[index].Topology;
                copy.submeshes[index].Indices.AddRange(submeshes[index].Indices);
            }
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
