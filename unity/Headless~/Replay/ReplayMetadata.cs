using System;
using System.Globalization;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// What a replay shows beside its frames. Metres, seconds, Unity's axes. Fill it before the <see cref="ReplayWriter"/> is
    /// made; later changes have no effect. Every number must be finite.
    /// </summary>
    public sealed class ReplayMetadata
    {
        private readonly JArray shapes = new JArray();
        private readonly JArray markers = new JArray();
        private JObject arena = Arena(-10, 0, -10, 10, 5, 10);

        public string Title { get; set; } = "Replay";
        public ulong Seed { get; set; }

        /// <summary>Nominal time between frames.</summary>
        public double DeltaTime { get; set; } = 0.1;

        public float NodeRadius { get; set; } = 0.25f;

        /// <summary>Name of the value that colours the nodes.</summary>
        public string ScalarName { get; set; } = "value";

        /// <summary>Unit of the scalar; null: none is shown.</summary>
        public string ScalarUnit { get; set; }

        /// <summary>Scalar at the lower end of the colours; null: the least of the recording.</summary>
        public float? ScalarMin { get; set; }

        /// <summary>Scalar at the upper end of the colours; null: the greatest of the recording.</summary>
        public float? ScalarMax { get; set; }

        /// <summary>The space that the first view frames; the floor is drawn at <paramref name="minY"/>.</summary>
        public void SetArena(float minX, float minY, float minZ, float maxX, float maxY, float maxZ)
        {
            if (!(minX < maxX && minY <= maxY && minZ < maxZ))
                throw new ArgumentException("The replay's arena must have its least corner first and a floor of some size.");
            arena = Arena(minX, minY, minZ, maxX, maxY, maxZ);
            ArenaSide = Math.Max((double)maxX - minX, Math.Max((double)maxY - minY, (double)maxZ - minZ));
        }

        /// <summary>A static box, turned by the unit quaternion; height 0 makes a plane.</summary>
        public void AddBox(
            float x, float y, float z, float width, float height, float depth,
            float rotationX = 0, float rotationY = 0, float rotationZ = 0, float rotationW = 1)
        {
            var rotation = Numbers(rotationX, rotationY, rotationZ, rotationW);
            shapes.Add(new JObject { ["kind"] = "box", ["centre"] = Numbers(x, y, z), ["size"] = Numbers(width, height, depth), ["rotation"] = rotation });
        }

        /// <summary>A static sphere.</summary>
        public void AddSphere(float x, float y, float z, float radius)
        {
            shapes.Add(new JObject { ["kind"] = "sphere", ["centre"] = Numbers(x, y, z), ["radius"] = Number(radius) });
        }

        /// <summary>A named place.</summary>
        public void AddMarker(string name, float x, float y, float z)
        {
            markers.Add(new JObject { ["name"] = Text(name), ["position"] = Numbers(x, y, z) });
        }

        /// <summary>The longest side of the arena.</summary>
        internal double ArenaSide { get; private set; } = 20;

        internal JObject ToJson()
        {
            var scalar = new JObject { ["name"] = Text(ScalarName) };
            if (ScalarUnit != null) scalar["unit"] = ScalarUnit;
            if (ScalarMin.HasValue) scalar["min"] = Number(ScalarMin.Value);
            if (ScalarMax.HasValue) scalar["max"] = Number(ScalarMax.Value);
            return new JObject
            {
                ["title"] = Text(Title),
                // Greater than what JavaScript's numbers hold exactly.
                ["seed"] = Seed.ToString(CultureInfo.InvariantCulture),
                ["deltaTime"] = Number(DeltaTime),
                ["nodeRadius"] = Number(NodeRadius),
                ["arena"] = arena,
                ["scalar"] = scalar,
                ["shapes"] = shapes,
                ["markers"] = markers,
            };
        }

        private static JObject Arena(float minX, float minY, float minZ, float maxX, float maxY, float maxZ) =>
            new JObject { ["min"] = Numbers(minX, minY, minZ), ["max"] = Numbers(maxX, maxY, maxZ) };

        private static JArray Numbers(params float[] numbers) => new JArray(Array.ConvertAll(numbers, number => (object)Number(number)));

        // JSON has no place for other numbers.
        private static double Number(double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
                throw new ArgumentException("A number of the replay's metadata is " + value.ToString(CultureInfo.InvariantCulture) + ": give a finite one.");
            return value;
        }

        private static float Number(float value) => (float)Number((double)value);

        private static string Text(string text) => text ?? throw new ArgumentNullException(nameof(text), "A name of the replay's metadata is missing.");
    }
}
