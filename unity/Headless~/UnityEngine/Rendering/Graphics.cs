using UnityEngine.Rendering;

namespace UnityEngine
{
    public struct RenderParams
    {
        public RenderParams(Material mat) : this()
        {
            material = mat;
            receiveShadows = true;
        }

        public int layer { get; set; }
        public uint renderingLayerMask { get; set; }
        public Bounds worldBounds { get; set; }
        public Material material { get; set; }
        public MaterialPropertyBlock matProps { get; set; }
        public ShadowCastingMode shadowCastingMode { get; set; }
        public bool receiveShadows { get; set; }
    }

    /// Records the draw calls of the frame in `Headless.DrawLog` instead of executing them.
    public class Graphics
    {
        public static void RenderPrimitives(in RenderParams rparams, MeshTopology topology, int vertexCount, int instanceCount = 1)
        {
            if (rparams.material == null) throw new System.InvalidOperationException("A draw needs a material.");
            Headless.DrawLog.Add(rparams, vertexCount, instanceCount);
        }

        public static void RenderMeshInstanced<T>(
            in RenderParams rparams, Mesh mesh, int submeshIndex, T[] instanceData, int instanceCount = -1, int startInstance = 0)
            where T : unmanaged
        {
            if (rparams.material == null) throw new System.InvalidOperationException("A draw needs a material.");
            if (!rparams.material.enableInstancing) throw new System.InvalidOperationException("The material does not enable instancing.");
            if (instanceData == null) throw new System.ArgumentNullException(nameof(instanceData));
            var count = instanceCount < 0 ? instanceData.Length - startInstance : instanceCount;
            if (startInstance < 0 || startInstance + count > instanceData.Length) throw new System.ArgumentOutOfRangeException(nameof(instanceCount));
            Headless.DrawLog.Add(rparams, 0, count);
        }
    }

    public sealed class Gizmos
    {
        public static Color color { get; set; } = Color.white;
        public static Matrix4x4 matrix { get; set; } = Matrix4x4.identity;
        public static void DrawLine(Vector3 from, Vector3 to) => Headless.DrawLog.Gizmos.Add("line " + from + " " + to);
        public static void DrawRay(Ray r) { }
        public static void DrawRay(Vector3 from, Vector3 direction) => Headless.DrawLog.Gizmos.Add("ray " + from + " " + direction);
        public static void DrawSphere(Vector3 center, float radius) { }
        public static void DrawWireSphere(Vector3 center, float radius) => Headless.DrawLog.Gizmos.Add("sphere " + center + " " + radius);
        public static void DrawCube(Vector3 center, Vector3 size) { }
        public static void DrawWireCube(Vector3 center, Vector3 size) { }
    }
}
