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

            internal Draw(Material material, Mesh mesh, int instances)
            {
                Material = material;
                Mesh = mesh;
                Instances = instances;
            }
        }

        static readonly List<Draw> Recorded = new List<Draw>();

        public static IReadOnlyList<Draw> Draws => Recorded;

        internal static void Add(Material material, Mesh mesh, int instances) => Recorded.Add(new Draw(material, mesh, instances));
        internal static void Clear() => Recorded.Clear();
    }
}
