using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;

namespace Collektive.Headless
{
    /// <summary>
    /// What a replay shows beside its frames. Metres, seconds, Unity's axes. Fill it before the <see cref="ReplayWriter"/> is
    /// made; later changes have no effect. Every number must be finite.
    /// </summary>
    public sealed class ReplayMetadata
    {
        private readonly List<string> shapes = new List<string>();
        private readonly List<string> markers = new List<string>();
        private string arena = "{\"min\":[-10,0,-10],\"max\":[10,5,10]}";

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
            arena = "{\"min\":" + Vector(minX, minY, minZ) + ",\"max\":" + Vector(maxX, maxY, maxZ) + "}";
        }

        /// <summary>A static box, turned by the unit quaternion; height 0 makes a plane.</summary>
        public void AddBox(
            float x, float y, float z, float width, float height, float depth,
            float rotationX = 0, float rotationY = 0, float rotationZ = 0, float rotationW = 1)
        {
            shapes.Add("{\"kind\":\"box\",\"centre\":" + Vector(x, y, z) + ",\"size\":" + Vector(width, height, depth) +
                ",\"rotation\":[" + Number(rotationX) + "," + Number(rotationY) + "," + Number(rotationZ) + "," + Number(rotationW) + "]}");
        }

        /// <summary>A static sphere.</summary>
        public void AddSphere(float x, float y, float z, float radius)
        {
            shapes.Add("{\"kind\":\"sphere\",\"centre\":" + Vector(x, y, z) + ",\"radius\":" + Number(radius) + "}");
        }

        /// <summary>A named place.</summary>
        public void AddMarker(string name, float x, float y, float z)
        {
            markers.Add("{\"name\":" + Text(name) + ",\"position\":" + Vector(x, y, z) + "}");
        }

        internal string ToJson()
        {
            var json = new StringBuilder();
            json.Append("{\"title\":").Append(Text(Title));
            json.Append(",\"seed\":\"").Append(Seed.ToString(CultureInfo.InvariantCulture)).Append('"');
            json.Append(",\"deltaTime\":").Append(Number(DeltaTime));
            json.Append(",\"nodeRadius\":").Append(Number(NodeRadius));
            json.Append(",\"arena\":").Append(arena);
            json.Append(",\"scalar\":{\"name\":").Append(Text(ScalarName));
            if (ScalarUnit != null) json.Append(",\"unit\":").Append(Text(ScalarUnit));
            if (ScalarMin.HasValue) json.Append(",\"min\":").Append(Number(ScalarMin.Value));
            if (ScalarMax.HasValue) json.Append(",\"max\":").Append(Number(ScalarMax.Value));
            json.Append("},\"shapes\":[").Append(string.Join(",", shapes));
            json.Append("],\"markers\":[").Append(string.Join(",", markers)).Append("]}");
            return json.ToString();
        }

        private static string Vector(float x, float y, float z)
        {
            return "[" + Number(x) + "," + Number(y) + "," + Number(z) + "]";
        }

        private static string Number(double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
                throw new ArgumentException("A number of the replay's metadata is " + value.ToString(CultureInfo.InvariantCulture) + ": give a finite one.");
            return value.ToString("R", CultureInfo.InvariantCulture);
        }

        private static string Text(string text)
        {
            var json = new StringBuilder("\"");
            foreach (var c in text ?? throw new ArgumentNullException(nameof(text), "A name of the replay's metadata is missing."))
            {
                if (c == '"' || c == '\\') json.Append('\\').Append(c);
                else if (c < ' ') json.Append("\\u").Append(((int)c).ToString("x4", CultureInfo.InvariantCulture));
                else json.Append(c);
            }
            return json.Append('"').ToString();
        }
    }
}
