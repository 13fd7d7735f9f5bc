using System;

namespace Unity.Profiling
{
    public readonly struct ProfilerCategory
    {
        public ProfilerCategory(string categoryName) => Name = categoryName;
        public string Name { get; }
        public static ProfilerCategory Scripts => new ProfilerCategory("Scripts");
        public static ProfilerCategory Physics => new ProfilerCategory("Physics");
    }

    /// Has no effect: the headless player has no profiler.
    public struct ProfilerMarker
    {
        public ProfilerMarker(string name) { }
        public ProfilerMarker(ProfilerCategory category, string name) { }
        public void Begin() { }
        public void Begin(UnityEngine.Object contextUnityObject) { }
        public void End() { }
        public AutoScope Auto() => default;

        public struct AutoScope : IDisposable
        {
            public void Dispose() { }
        }
    }
}
