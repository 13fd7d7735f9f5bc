using System;
using System.Collections.Generic;
using System.Threading;

namespace UnityEngine.Headless
{
    /// Runs the continuations of `async` methods on the main thread, like Unity. Otherwise, they would run on other threads during ticks.
    sealed class MainThreadContext : SynchronizationContext
    {
        readonly Thread main = Thread.CurrentThread;
        readonly List<(SendOrPostCallback Call, object State)> posted = new List<(SendOrPostCallback, object)>();

        public override void Post(SendOrPostCallback d, object state)
        {
            lock (posted) posted.Add((d, state));
        }

        public override void Send(SendOrPostCallback d, object state)
        {
            if (Thread.CurrentThread != main) throw new NotSupportedException("Send blocks until the next frame: call Post");
            d(state);
        }

        public override SynchronizationContext CreateCopy() => this;

        /// Runs the calls that were posted before. The next frame runs calls that are posted meanwhile.
        internal void Run()
        {
            (SendOrPostCallback Call, object State)[] calls;
            lock (posted)
            {
                if (posted.Count == 0) return;
                calls = posted.ToArray();
                posted.Clear();
            }
            foreach (var (call, state) in calls) Loop.InvokeAll(() => call(state));
        }
    }
}
