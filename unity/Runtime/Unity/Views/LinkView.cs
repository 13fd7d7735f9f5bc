using System;
using Collektive.Bridge;
using UnityEngine;
using UnityEngine.Rendering;

namespace Collektive.Unity
{
    /// <summary>
    /// Draws all links in a few instanced draws, without a GameObject for any of them. Each directed link is drawn from its sender half of the way
    /// to its receiver: two nodes that hear each other are joined by a whole line. What is drawn is that of the last tick.
    /// </summary>
    [AddComponentMenu("Collektive/Link View")]
    [DisallowMultipleComponent]
    public sealed class LinkView : MonoBehaviour
    {
        /// <summary>Unity's limit of instances in one draw.</summary>
        private const int MaxInstances = 1023;

        [SerializeField]
        [Tooltip("Material with GPU instancing on; its colour is replaced. None: the package's own.")]
        private Material material;

        [SerializeField]
        [Min(0.001f)]
        [Tooltip("Thickness of a link in metres.")]
        private float width = 0.04f;

        [SerializeField]
        [Tooltip("What links are coloured by.")]
        private LinkColoring coloring;

        [SerializeField]
        [Tooltip("Colours of numbers; by direction: the high one where two nodes hear each other, the low one where only one does.")]
        private ColorScale scale = new ColorScale();

        private readonly Matrix4x4[][] places = new Matrix4x4[ColorScale.Steps][];
        private readonly int[] counts = new int[ColorScale.Steps];
        private readonly Material[] materials = new Material[ColorScale.Steps];
        // By node id.
        private Vector3[] positions = Array.Empty<Vector3>();
        private Mesh mesh;
        private Bounds bounds;
        private SimulationManager drawn;
        private ulong tick;

        /// <summary>Material whose colour is replaced; null: the package's own. Read when the component is enabled.</summary>
        public Material Material
        {
            get => material;
            set => material = value;
        }

        /// <summary>Thickness of a link in metres, greater than 0.</summary>
        public float Width
        {
            get => width;
            set => width = value;
        }

        /// <summary>What links are coloured by.</summary>
        public LinkColoring Coloring
        {
            get => coloring;
            set => coloring = value;
        }

        /// <summary>The colours.</summary>
        public ColorScale Scale => scale;

        /// <summary>The number that a link is coloured by with <see cref="LinkColoring.Value"/>. Called once for each link and tick.</summary>
        public Func<LinkRecord, float> Value { get; set; }

        private void OnEnable()
        {
            var shader = material == null ? Shader.Find("Collektive/Surface") : null;
            if (material == null && shader == null)
            {
                Debug.LogError("Link View on '" + name + "' has no material, and the package's shader is not in this player: name a material", this);
                enabled = false;
                return;
            }
            mesh = MakeMesh();
            for (var step = 0; step < materials.Length; step++)
            {
                materials[step] = material == null ? new Material(shader) : new Material(material);
                materials[step].enableInstancing = true;
                places[step] = places[step] ?? Array.Empty<Matrix4x4>();
            }
            drawn = null;
        }

        private void OnDisable()
        {
            Destroy(mesh);
            for (var step = 0; step < materials.Length; step++)
            {
                Destroy(materials[step]);
                counts[step] = 0;
            }
        }

        private void LateUpdate()
        {
            var manager = SimulationManager.Current;
            if (manager == null) return;
            if (drawn != manager || tick != manager.Tick) Collect(manager);
            drawn = manager;
            tick = manager.Tick;
            for (var step = 0; step < materials.Length; step++) Draw(step);
        }

        private void Draw(int step)
        {
            if (counts[step] == 0) return;
            var parameters = new RenderParams(materials[step])
            {
                layer = gameObject.layer,
                worldBounds = bounds,
                shadowCastingMode = ShadowCastingMode.Off,
                receiveShadows = false,
            };
            for (var start = 0; start < counts[step]; start += MaxInstances)
            {
                Graphics.RenderMeshInstanced(parameters, mesh, 0, places[step], Math.Min(MaxInstances, counts[step] - start), start);
            }
        }

        private void Collect(SimulationManager manager)
        {
            TakePositions(manager);
            var links = manager.PresentLinks;
            scale.Begin();
            for (var i = 0; i < links.Capacity; i++)
            {
                if (links.TryGet(i, out var link)) scale.Include(NumberOf(link, links));
            }
            Array.Clear(counts, 0, counts.Length);
            for (var i = 0; i < links.Capacity; i++)
            {
                if (!links.TryGet(i, out var link)) continue;
                var step = coloring == LinkColoring.Direction ? NumberOf(link, links) > 0 ? ColorScale.Steps - 1 : 0 : scale.StepOf(NumberOf(link, links));
                Add(step, positions[link.From], positions[link.To]);
            }
            for (var step = 0; step < materials.Length; step++) materials[step].Paint(scale.At(step));
        }

        private float NumberOf(in LinkRecord link, LinkTable links)
        {
            switch (coloring)
            {
                case LinkColoring.Length: return link.Length;
                case LinkColoring.Attenuation: return link.Attenuation;
                case LinkColoring.Value: return Value == null ? 0 : Value(link);
                default: return links.Contains(link.To, link.From) ? 1 : 0;
            }
        }

        private void TakePositions(SimulationManager manager)
        {
            if (positions.Length < manager.IdCapacity) Array.Resize(ref positions, manager.IdCapacity);
            var nodes = manager.Nodes;
            bounds = default;
            for (var i = 0; i < nodes.Count; i++)
            {
                var position = nodes[i].Body.position;
                positions[nodes[i].Id] = position;
                if (i == 0) bounds = new Bounds(position, width * Vector3.one);
                else bounds.Encapsulate(position);
            }
        }

        /// <summary>The matrix that lays the mesh from a point half of the way to another; nothing is drawn between nodes at one point.</summary>
        private void Add(int step, Vector3 from, Vector3 to)
        {
            var way = 0.5f * (to - from);
            var length = way.magnitude;
            if (!(length > 0)) return;
            var side = Vector3.Cross(Mathf.Abs(way.y) < 0.9f * length ? Vector3.up : Vector3.right, way);
            side *= width / side.magnitude;
            var top = Vector3.Cross(way, side) / length;
            if (counts[step] == places[step].Length) Array.Resize(ref places[step], Math.Max(64, 2 * counts[step]));
            ref var place = ref places[step][counts[step]++];
            place.m00 = side.x; place.m01 = top.x; place.m02 = way.x; place.m03 = from.x;
            place.m10 = side.y; place.m11 = top.y; place.m12 = way.y; place.m13 = from.y;
            place.m20 = side.z; place.m21 = top.z; place.m22 = way.z; place.m23 = from.z;
            place.m30 = 0; place.m31 = 0; place.m32 = 0; place.m33 = 1;
        }

        /// <summary>A bar from the origin one metre along z, one metre wide and high, without ends.</summary>
        private static Mesh MakeMesh()
        {
            var corners = new Vector3[16];
            var normals = new Vector3[16];
            var triangles = new int[24];
            for (var side = 0; side < 4; side++)
            {
                var outwards = Quaternion.AngleAxis(90 * side, Vector3.forward) * Vector3.up;
                var along = Vector3.Cross(outwards, Vector3.forward);
                for (var corner = 0; corner < 4; corner++)
                {
                    corners[4 * side + corner] = 0.5f * outwards + (corner % 2 == 0 ? -0.5f : 0.5f) * along + (corner < 2 ? Vector3.zero : Vector3.forward);
                    normals[4 * side + corner] = outwards;
                }
                var first = 4 * side;
                var order = new[] { 0, 1, 2, 1, 3, 2 };
                for (var i = 0; i < order.Length; i++) triangles[6 * side + i] = first + order[i];
            }
            return new Mesh { name = "Link", vertices = corners, normals = normals, triangles = triangles };
        }
    }
}
