namespace UnityEngine
{
    public sealed class SystemInfo
    {
        public static bool supportsComputeShaders => Headless.Loop.HasComputeShaders;
    }
}
