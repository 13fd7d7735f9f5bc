using System.Collections.Generic;

namespace UnityEngine.Headless
{
    /// Records the draw calls of the current frame, for tests.
    public static class DrawLog
    {
        public readonly struct Draw
        {
            public readonly Material Material;
            /// The property block that the caller passed, or null.
            public readonly MaterialPropertyBlock Properties;
            public readonly Bounds Bounds;
            public readonly int Vertices;
            public readonly int Instances;

            /// Returns the content of a buffer in the form that the shader reads.
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

        /// Number of graphics buffers that were not released. Unity logs a warning when the garbage collector finds such a buffer.
        public static int Buffers { get; internal set; }

        /// The drawn gizmos as texts such as "line (from) (to)", "ray (from) (direction)" and "sphere (centre) radius". Tests clear the list.
        public static List<string> Gizmos { get; } = new List<string>();

        internal static void Add(in RenderParams parameters, int vertices, int instances) => Recorded.Add(new Draw(parameters, vertices, instances));

        internal static void Clear() => Recorded.Clear();
    }
}
