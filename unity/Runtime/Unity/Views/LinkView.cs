using System;
using Collektive.Bridge;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.Serialization;

namespace Collektive.Unity
{
    /// <summary>
    /// Draws all links of the last tick in one draw call, without a GameObject or a matrix per link. The shader reads two buffers, with the positions of
    /// the nodes and the pairs of linked nodes. Each directed link is drawn from its sender to the midpoint, so two opposite links form a complete line.
    /// </summary>
    [AddComponentMenu("Collektive/Link View")]
    [DisallowMultipleComponent]
    [HelpPage("sensors-and-actuators.md#views")]
    public sealed class LinkView : MonoBehaviour
    {
        /// <summary>Number of vertices of the two bars that the shader draws for a pair.</summary>
        private const int VerticesPerPair = 48;

        /// <summary>Colour step for which the shader draws nothing.</summary>
        private const int NoLink = 255;

        [SerializeField]
        [Tooltip("Material with the shader Collektive/Link, or one that reads the same buffers. None: the package's material.")]
        private Material material;

        [SerializeField]
        [Min(0.001f)]
        [Tooltip("Thickness of a link in metres.")]
        private float width = 0.04f;

        [SerializeField]
        [Min(0)]
        [Tooltip("Maximum number of links. No links are drawn if the scene has more. 100,000 links take 2 ms per tick.")]
        private int limit = 100000;

        [SerializeField]
        [FormerlySerializedAs("coloring")]
        [Tooltip("Value that determines the colour of links.")]
        private LinkColouring colouring;

        [SerializeField]
        [Tooltip("Colours of the values. By direction: the high colour for links in both directions, the low one for one-way links.")]
        private ColourScale scale = new ColourScale();

        private GraphicsBuffer placesBuffer;
        private GraphicsBuffer pairsBuffer;
        private MaterialPropertyBlock properties;
        private Material used;
        // The material that this component creates if none was selected.
        private Material own;
        private Vector4[] places = new Vector4[64];
        private LinkedPair[] pairs = new LinkedPair[64];
        // The numbers by which links are coloured, two for each pair.
        private float[] numbers = Array.Empty<float>();
        // A node's index in places, by node id.
        private readonly PagedArray<int> placeOf = new PagedArray<int>();
        private Bounds bounds;
        private int count;
        private bool hasReportedLimit;
        private SimulationManager drawnManager;
        private ulong tick;

        /// <summary>
        /// A pair of nodes in the form that the shader reads. For each node, it contains the node's index in the positions and, in the upper 8 bits, the
        /// colour step of the link that the node sends on.
        /// </summary>
        private struct LinkedPair
        {
            internal uint Low;
            internal uint High;
        }

        /// <summary>
        /// Material with the shader Collektive/Link or another shader that reads the same buffers; null: the package's material. Read when the component is
        /// enabled.
        /// </summary>
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

        /// <summary>Maximum number of directed links, 0 or greater. No links are drawn if the scene has more.</summary>
        public int Limit
        {
            get => limit;
            set => limit = value;
        }

        /// <summary>The value that determines the colour of links.</summary>
        public LinkColouring Colouring
        {
            get => colouring;
            set => colouring = value;
        }

        /// <summary>The colours.</summary>
        public ColourScale Scale => scale;

        /// <summary>
        /// Returns the number by which a link is coloured if <see cref="Colouring"/> is <see cref="LinkColouring.Value"/>. Called once for each link and
        /// tick.
        /// </summary>
        public Func<LinkRecord, float> Value { get; set; }

        private void OnEnable()
        {
            if (!SystemInfo.supportsComputeShaders)
            {
                Debug.Log("Link View on '" + name + "' is disabled, because this graphics device does not support compute shaders", this);
                enabled = false;
                return;
            }
            var shader = material == null ? Shader.Find("Collektive/Link") : null;
            if (material == null && shader == null)
            {
                Debug.LogError("Link View on '" + name + "' has no material, and the shader Collektive/Link is not in this player: select a material, "
                    + "or add the shader to Always Included Shaders", this);
                enabled = false;
                return;
            }
            if (material != null && !material.HasProperty(ShaderNames.Width))
            {
                Debug.LogError("Link View on '" + name + "' cannot draw with the material '" + material.name
                    + "', whose shader does not draw links: use one with the shader Collektive/Link, or none", this);
                enabled = false;
                return;
            }
            if (material == null) own = new Material(shader);
            used = material == null ? own : material;
            properties = new MaterialPropertyBlock();
            drawnManager = null;
            count = 0;
        }

        private void OnDisable()
        {
            if (own != null) Destroy(own);
            placesBuffer?.Release();
            pairsBuffer?.Release();
            placesBuffer = null;
            pairsBuffer = null;
        }

        private void LateUpdate()
        {
            var manager = SimulationManager.Current;
            if (manager == null) return;
            if (drawnManager != manager || tick != manager.Tick) Take(manager);
            drawnManager = manager;
            tick = manager.Tick;
            if (count > 0) Draw();
        }

        private void Draw()
        {
            properties.SetFloat(ShaderNames.Width, width);
            properties.SetVector(ShaderNames.Low, scale.low);
            properties.SetVector(ShaderNames.High, scale.high);
            var parameters = new RenderParams(used)
            {
                layer = gameObject.layer,
                worldBounds = bounds,
                matProps = properties,
                shadowCastingMode = ShadowCastingMode.Off,
                receiveShadows = false,
            };
            Graphics.RenderPrimitives(parameters, MeshTopology.Triangles, VerticesPerPair, count);
        }

        private void Take(SimulationManager manager)
        {
            count = 0;
            var links = manager.Simulation.PresentLinks;
            if (links.Count > limit)
            {
                if (!hasReportedLimit) Debug.LogWarning("the scene has " + links.Count + " links, but the Link View draws at most " + limit
                    + ": no links are drawn while "
                    + "there are more. Raise its Limit, or use smaller neighbourhoods", this);
                hasReportedLimit = true;
                return;
            }
            CollectPositions(manager);
            var all = links.Pairs;
            if (pairs.Length < all.Length) Array.Resize(ref pairs, links.PairCapacity);
            if (colouring != LinkColouring.Direction) ReadNumbers(all, links.PairCapacity);
            for (var i = 0; i < all.Length; i++)
            {
                ref var pair = ref all[i];
                var up = pair.Up.References > 0;
                var down = pair.Down.References > 0;
                if (!up && !down) continue;
                ref var taken = ref pairs[count++];
                taken.Low = End(pair.Low, up ? StepOf(2 * i, down) : NoLink);
                taken.High = End(pair.High, down ? StepOf(2 * i + 1, up) : NoLink);
            }
            if (count == 0) return;
            Upload(ref placesBuffer, ShaderNames.Places, places, manager.Nodes.Count, 4 * sizeof(float));
            Upload(ref pairsBuffer, ShaderNames.Pairs, pairs, count, 2 * sizeof(uint));
        }

        private uint End(int id, int step) => (uint)placeOf[id] | (uint)step << 24;

        private int StepOf(int link, bool isBothWays)
        {
            if (colouring == LinkColouring.Direction) return isBothWays ? ColourScale.Steps - 1 : 0;
            return scale.StepOf(numbers[link]);
        }

        /// <summary>Reads the number of each link, and extends an automatic scale to include it.</summary>
        private void ReadNumbers(Span<LinkPair> all, int capacity)
        {
            if (numbers.Length < 2 * all.Length) Array.Resize(ref numbers, 2 * capacity);
            var least = float.PositiveInfinity;
            var most = float.NegativeInfinity;
            for (var i = 0; i < all.Length; i++)
            {
                ref var pair = ref all[i];
                if (pair.Up.References > 0) Include(numbers[2 * i] = NumberOf(pair.Low, pair.High, pair.Up), ref least, ref most);
                if (pair.Down.References > 0) Include(numbers[2 * i + 1] = NumberOf(pair.High, pair.Low, pair.Down), ref least, ref most);
            }
            scale.Begin();
            scale.Include(least);
            scale.Include(most);
        }

        private static void Include(float number, ref float least, ref float most)
        {
            if (number < least && number >= float.MinValue) least = number;
            if (number > most && number <= float.MaxValue) most = number;
        }

        private float NumberOf(int from, int to, in LinkDirection direction)
        {
            if (colouring == LinkColouring.Length) return direction.Length;
            if (colouring == LinkColouring.Attenuation) return direction.Attenuation;
            return Value == null ? 0 : Value(direction.Record(from, to));
        }

        private void CollectPositions(SimulationManager manager)
        {
            var nodes = manager.Nodes;
            if (places.Length < nodes.Count) Array.Resize(ref places, Math.Max(nodes.Count, 2 * places.Length));
            var min = Vector3.positiveInfinity;
            var max = Vector3.negativeInfinity;
            for (var i = 0; i < nodes.Count; i++)
            {
                var node = nodes[i];
                // The transform has the position after physics, but Node.Position is the position before the tick.
                var position = node.Body.position;
                placeOf[node.Id] = i;
                places[i] = position;
                min = Vector3.Min(min, position);
                max = Vector3.Max(max, position);
            }
            if (nodes.Count > 0) bounds = new Bounds(0.5f * (min + max), max - min + width * Vector3.one);
        }

        /// <summary>Copies the first items of an array to a buffer with room for the whole array.</summary>
        private void Upload<T>(ref GraphicsBuffer buffer, int shaderName, T[] items, int itemCount, int bytes)
        {
            if (buffer == null || buffer.count < items.Length)
            {
                buffer?.Release();
                buffer = new GraphicsBuffer(GraphicsBuffer.Target.Structured, items.Length, bytes);
                properties.SetBuffer(shaderName, buffer);
            }
            buffer.SetData(items, 0, 0, itemCount);
        }

        /// <summary>Names of properties and buffers in the shader.</summary>
        private static class ShaderNames
        {
            internal static readonly int Places = Shader.PropertyToID("_LinkPlaces");
            internal static readonly int Pairs = Shader.PropertyToID("_LinkPairs");
            internal static readonly int Low = Shader.PropertyToID("_LinkLow");
            internal static readonly int High = Shader.PropertyToID("_LinkHigh");
            internal static readonly int Width = Shader.PropertyToID("_LinkWidth");
        }
    }
}
