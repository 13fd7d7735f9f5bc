using System;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>A flight recording of a run. It starts before the first tick, and its file is written when it is disposed.</summary>
    internal sealed class RecordedRun : IDisposable
    {
        /// <summary>Number of stack frames per sample. Aggregate programs have deep stacks, and none of their frames must be cut off.</summary>
        private const string StackDepth = "-XX:FlightRecorderOptions=stackdepth=512";

        internal RecordedRun(JvmSettings settings, string path)
        {
            settings.flags.Add(StackDepth);
            Jvm.Start(Installation.ToLaunch(settings));
            JvmRecording.Start(path, JvmRecording.Profile);
            WaitFor(RecordingState.On);
        }

        public void Dispose()
        {
            if (Jvm.State != JvmState.Running) return;
            JvmRecording.Stop();
            WaitFor(RecordingState.Off);
        }

        private static void WaitFor(RecordingState state)
        {
            while (true)
            {
                var status = Jvm.GetStatus();
                if (status.RecordingError.Length > 0) throw new ScenarioException(status.RecordingError);
                if (status.Recording == state) return;
                Thread.Sleep(5);
            }
        }
    }
}
