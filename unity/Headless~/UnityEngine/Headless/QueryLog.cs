namespace UnityEngine.Headless
{
    /// Counts physics queries, for tests.
    public static class QueryLog
    {
        /// Rays cast since the process began.
        public static long Rays { get; internal set; }

        /// Batches of queries since the process began.
        public static long Batches { get; internal set; }

        /// Batches that ran in the background before their results were requested.
        public static long BatchesStartedEarly { get; internal set; }

        /// Whether a batch is running in the background.
        public static bool IsRunning => OverlapBatch.IsRunning;
    }
}
