using UnityEngine;

namespace Unity.Jobs
{
    /// The handle of a batch of physics queries. Scheduled batches wait until `ScheduleBatchedJobs`, `IsCompleted` or `Complete` of any handle.
    public struct JobHandle
    {
        readonly int number;

        internal JobHandle(int number) => this.number = number;

        public bool IsCompleted
        {
            get
            {
                QueryJobs.Start();
                return !QueryJobs.IsRunning(number);
            }
        }

        public static void ScheduleBatchedJobs()
        {
            UnityEngine.Headless.QueryLog.BatchesStartedEarly += QueryJobs.Count;
            QueryJobs.Start();
        }

        public void Complete()
        {
            QueryJobs.Start();
            if (QueryJobs.IsRunning(number)) OverlapBatch.Finish();
        }
    }
}
