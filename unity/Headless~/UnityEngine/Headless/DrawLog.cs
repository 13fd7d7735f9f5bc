using System.Collections.Generic;

namespace UnityEngine.Headless
{
    /// What was asked to be drawn in the current frame, for tests.
    public static class DrawLog
    {
        public readonly struct Draw
        {
            public readonly Material Material;
            public readonly Mesh Mesh;
            public readonly int Instances;
            /// The caller's own array or list of what is drawn from the first instance on; null for a single mesh.
            public readonly object Data;
            public readonly int Start;

            internal Draw(Material material, Mesh mesh, int instances, object data, int start)
            {
                Material = material;
                Mesh = mesh;
                Instances = instances;
                Data = data;
                Start = start;
            }
        }

        static readonly List<Draw> Recorded = new List<Draw>();

        public static IReadOnlyList<Draw> Draws => Recorded;

        /// Gizmos as text, "line (from) (to)", "ray (from) (direction)", "sphere (centre) radius"; for the test to empty.
        public static List<string> Gizmos { get; } = new List<string>();

        internal static void Add(Material material, Mesh mesh, int instances, object data = null, int start = 0) =>
            Recorded.Add(new Draw(material, mesh, instances, data, start));

        internal static void Clear() => Recorded.Clear();
    }
}
