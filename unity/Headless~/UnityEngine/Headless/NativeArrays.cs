namespace UnityEngine.Headless
{
    /// Native arrays in use, for tests.
    public static class NativeArrays
    {
        /// Those that were made and not disposed.
        public static int Count { get; internal set; }
    }
}
