using System;
using System.Collections.Generic;
using System.Globalization;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// The data of a replay that does not change from frame to frame, in metres, seconds and Unity's axes. Fill it before you create the <see
    /// cref="ReplayWriter"/>, because later changes have no effect. All numbers must be finite.
    /// </summary>
    public sealed class ReplayMetadata
    {
        private readonly JArray shapes = new JArray();
        private readonly JArray markers = new JArray();

        public string Title { get; set; } = "Replay";
        public ulong Seed { get; set; }

        /// <summary>Nominal time between frames.</summary>
        public double DeltaTime { get; set; } = 0.1;

        public float NodeRadius { get; set; } = 0.25f;

        /// <summary>Height of nodes that are upright capsules, including both caps; 0 for spheres.</summary>
        public float NodeHeight { get; set; }

        /// <summary>Fields by which nodes can be coloured, at least one. The page starts with the first field.</summary>
        public IReadOnlyList<ReplayField> Fields { get; set; } = new[] { new ReplayField("value") };

        /// <summary>Metrics for charts, or null. Rows may be added until the replay is finished.</summary>
        public ReplayMetrics Metrics { get; set; }

        /// <summary>Sets the space that the first view shows. The floor is at <paramref name="minY"/>.</summary>
        /// <param name="grows">
        /// Whether the space grows to include nodes outside it. Each end of an axis moves by at most the longest side, so that a distant node does not make
        /// all others small.
        /// </param>
        public void SetArena(float minX, float minY, float minZ, float maxX, float maxY, float maxZ, bool grows = false)
        {
            if (!(minX < maxX && minY <= maxY && minZ < maxZ))
                throw new ArgumentException("Pass the arena's minimum corner first; its width and depth must be greater than 0.");
            foreach (var coordinate in new[] { minX, minY, minZ, maxX, maxY, maxZ }) Number(coordinate);
            Arena = new ReplayArena(new[] { minX, minY, minZ }, new[] { maxX, maxY, maxZ }, grows);
        }

        /// <summary>Adds a static box with a rotation (unit quaternion). Height 0 makes a plane.</summary>
        public void AddBox(
            float x, float y, float z, float width, float height, float depth,
            float rotationX = 0, float rotationY = 0, float rotationZ = 0, float rotationW = 1)
        {
            shapes.Add(ShapeAt(Box(width, height, depth), x, y, z, rotationX, rotationY, rotationZ, rotationW));
        }

        /// <summary>Adds a static triangle mesh with a rotation (unit quaternion).</summary>
        /// <param name="vertices">x, y, z of each corner in local axes.</param>
        /// <param name="triangles">Three indices of corners per triangle.</param>
        public void AddMesh(
            float[] vertices, int[] triangles, float x, float y, float z, float rotationX, float rotationY, float rotationZ, float rotationW)
        {
            shapes.Add(ShapeAt(Mesh(vertices, triangles), x, y, z, rotationX, rotationY, rotationZ, rotationW));
        }

        /// <summary>Adds a moving box. Its pose must be added in each frame.</summary>
        public ReplayMover AddMovingBox(float width, float height, float depth) => AddMover(Box(width, height, depth));

        /// <summary>Adds a moving sphere. Its pose must be added in each frame.</summary>
        public ReplayMover AddMovingSphere(float radius) => AddMover(new JObject { ["kind"] = "sphere", ["radius"] = Number(radius) });

        /// <summary>Adds a static sphere.</summary>
        public void AddSphere(float x, float y, float z, float radius)
        {
            shapes.Add(new JObject { ["kind"] = "sphere", ["centre"] = Numbers(x, y, z), ["radius"] = Number(radius) });
        }

        /// <summary>Adds a static capsule with a rotation (unit quaternion).</summary>
        /// <param name="height">Height including both caps.</param>
        /// <param name="axis">Local axis of the capsule: 0, 1, 2 for x, y, z.</param>
        public void AddCapsule(
            float x, float y, float z, float radius, float height, int axis, float rotationX, float rotationY, float rotationZ, float rotationW)
        {
            shapes.Add(ShapeAt(Capsule(radius, height, axis), x, y, z, rotationX, rotationY, rotationZ, rotationW));
        }

        /// <summary>Adds a moving capsule with the parameters of <see cref="AddCapsule"/>. Its pose must be added in each frame.</summary>
        public ReplayMover AddMovingCapsule(float radius, float height, int axis) => AddMover(Capsule(radius, height, axis));

        /// <summary>Adds a named place.</summary>
        public void AddMarker(string name, float x, float y, float z)
        {
            markers.Add(new JObject { ["name"] = Text(name), ["position"] = Numbers(x, y, z) });
        }

        /// <summary>Adds a moving triangle mesh with the parameters of <see cref="AddMesh"/>. Its pose must be added in each frame.</summary>
        public ReplayMover AddMovingMesh(float[] vertices, int[] triangles) => AddMover(Mesh(vertices, triangles));

        internal ReplayArena Arena { get; private set; } = new ReplayArena(new[] { -10f, 0, -10 }, new[] { 10f, 5, 10 }, false);

        /// <summary>The shapes that move.</summary>
        internal List<ReplayMover> Movers { get; } = new List<ReplayMover>();

        internal JObject ToJson()
        {
            return new JObject
            {
                ["title"] = Text(Title),
                // The seed is stored as text, because it may exceed the integers that JavaScript represents exactly.
                ["seed"] = Seed.ToString(CultureInfo.InvariantCulture),
                ["deltaTime"] = Number(DeltaTime),
                ["nodeRadius"] = Number(NodeRadius),
                ["nodeHeight"] = Number(NodeHeight),
                ["arena"] = Arena.ToJson(),
                ["shapes"] = shapes,
                ["markers"] = markers,
            };
        }

        private ReplayMover AddMover(JObject shape)
        {
            var mover = new ReplayMover(shape);
            Movers.Add(mover);
            return mover;
        }

        private static JObject Box(float width, float height, float depth) =>
            new JObject { ["kind"] = "box", ["size"] = Numbers(width, height, depth) };

        private static JObject Capsule(float radius, float height, int axis) =>
            new JObject { ["kind"] = "capsule", ["radius"] = Number(radius), ["height"] = Number(height), ["axis"] = axis };

        private static JObject Mesh(float[] vertices, int[] triangles) =>
            new JObject { ["kind"] = "mesh", ["vertices"] = Numbers(vertices), ["triangles"] = new JArray(triangles) };

        private static JObject ShapeAt(
            JObject shape, float x, float y, float z, float rotationX, float rotationY, float rotationZ, float rotationW)
        {
            shape["centre"] = Numbers(x, y, z);
            shape["rotation"] = Numbers(rotationX, rotationY, rotationZ, rotationW);
            return shape;
        }

        internal static JArray Numbers(params float[] numbers) => new JArray(Array.ConvertAll(numbers, number => (object)Number(number)));

        // Rejects NaN and infinity, which JSON cannot represent.
        internal static double Number(double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
                throw new ArgumentException("The replay's metadata contains " + value.ToString(CultureInfo.InvariantCulture) + ": use finite numbers.");
            return value;
        }

        internal static float Number(float value) => (float)Number((double)value);

        private static string Text(string text) => text ?? throw new ArgumentNullException(nameof(text), "A name of the replay's metadata is missing.");
    }
}
