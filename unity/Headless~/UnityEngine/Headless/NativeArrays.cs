namespace UnityEngine.Headless
{
    /// Counts native arrays, for tests.
    public static class NativeArrays
    {
        /// Number of arrays that were not disposed.
        public static int Count { get; internal set; }
    }
}
