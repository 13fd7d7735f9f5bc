using System;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>Flight recording that starts before the first tick of a run. Disposing it writes the file.</summary>
    internal sealed class RecordedRun : IDisposable
    {
        /// <summary>Frames per sample: aggregate programs nest deeply, and their own frames must not be cut off.</summary>
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
