using Unity.Profiling;

namespace Collektive.Unity
{
    /// <summary>The phases of a tick in Unity's profiler; <see cref="TickTimes"/> measures the same ones.</summary>
    internal static class TickMarkers
    {
        internal static readonly ProfilerMarker Tick = new ProfilerMarker("Collektive.Tick");
        internal static readonly ProfilerMarker Queries = new ProfilerMarker("Collektive.Queries");
        internal static readonly ProfilerMarker Rules = new ProfilerMarker("Collektive.Rules");
        internal static readonly ProfilerMarker Sense = new ProfilerMarker("Collektive.Sense");
        internal static readonly ProfilerMarker Step = new ProfilerMarker("Collektive.Step");
        internal static readonly ProfilerMarker Act = new ProfilerMarker("Collektive.Act");
        internal static readonly ProfilerMarker Physics = new ProfilerMarker("Collektive.Physics");
    }
}
