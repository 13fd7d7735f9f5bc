using System.Collections.Generic;

namespace UnityEngine.Headless
{
    /// Records the draw calls of the current frame, for tests.
    public static class DrawLog
    {
        public readonly struct Draw
        {
            public readonly Material Material;
            /// The caller's property block, or null.
            public readonly MaterialPropertyBlock Properties;
            public readonly Bounds Bounds;
            public readonly int Vertices;
            public readonly int Instances;

            /// Returns a buffer as the shader reads it.
            public T[] Read<T>(string buffer)
                where T : struct => Properties.BufferOf(buffer).Data<T>();

            internal Draw(in RenderParams parameters, int vertices, int instances)
            {
                Material = parameters.material;
                Properties = parameters.matProps;
                Bounds = parameters.worldBounds;
                Vertices = vertices;
                Instances = instances;
            }
        }

        static readonly List<Draw> Recorded = new List<Draw>();

        public static IReadOnlyList<Draw> Draws => Recorded;

        /// Number of unreleased graphics buffers. Unity warns when the garbage collector finds one.
        public static int Buffers { get; internal set; }

        /// Gizmos as text: "line (from) (to)", "ray (from) (direction)", "sphere (centre) radius". Tests clear the list.
        public static List<string> Gizmos { get; } = new List<string>();

        internal static void Add(in RenderParams parameters, int vertices, int instances) => Recorded.Add(new Draw(parameters, vertices, instances));

        internal static void Clear() => Recorded.Clear();
    }
}
