using UnityEngine;

namespace Unity.Jobs
{
    /// Of jobs that are done when they are scheduled, or of a batch of overlaps.
    public struct JobHandle
    {
        readonly int batch;

        internal JobHandle(int batch) => this.batch = batch;

        bool IsRunning => OverlapBatch.IsRunning && batch == OverlapBatch.Number;

        public bool IsCompleted => !IsRunning;

        public void Complete()
        {
            if (IsRunning) OverlapBatch.Finish();
        }
    }
}
