namespace UnityEngine.Headless
{
    /// Native arrays in use, for tests.
    public static class NativeArrays
    {
        /// Number of undisposed arrays.
        public static int Count { get; internal set; }
    }
}
