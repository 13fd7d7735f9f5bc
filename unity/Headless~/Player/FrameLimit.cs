using System;
using System.Diagnostics;
using System.Threading;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>
    /// Ends frames and metrics of the scene whose C# code does not return. The JVM applies <see cref="SimulationSettings.stepLimitMs"/> to its part of a
    /// tick. Therefore, a frame that takes twice as long has exceeded the limit in C#. Metrics have the same limit. Before the simulation is open, frames
    /// have no limit.
    /// </summary>
    internal sealed class FrameLimit : IDisposable
    {
        private const int PollMs = 50;

        /// <summary>Time in which an aborted frame must end. It may not end, because native code ignores the abort.</summary>
        private const int AbortMs = 3000;

        private readonly object gate = new object();
        private readonly Thread player = Thread.CurrentThread;
        private readonly Stopwatch clock = new Stopwatch();
        private readonly SimulationManager manager;
        private readonly Action giveUp;
        private int tick;
        private bool isMeasuring;
        private bool isDisposed;

        /// <param name="giveUp">Called on another thread if an aborted frame does not end. It must not return.</param>
        internal FrameLimit(SimulationManager manager, Action giveUp)
        {
            this.manager = manager;
            this.giveUp = giveUp;
            new Thread(Watch) { IsBackground = true }.Start();
        }

        /// <summary>Whether the frame's thread was aborted.</summary>
        internal bool IsExceeded { get; private set; }

        internal string Message =>
            "stopped at tick " + tick + ": " + (isMeasuring ? "the metrics of the scene" : "sensors, actuators, rules or scripts") + " exceeded 'stepLimitMs', "
                + manager.Settings.stepLimitMs + " ms";

        internal void Begin(int nextTick) => Begin(nextTick, false);

        internal void BeginMetrics() => Begin((int)manager.Tick, true);

        internal void End()
        {
            lock (gate) clock.Reset();
        }

        public void Dispose()
        {
            lock (gate) isDisposed = true;
        }

        private void Begin(int tick, bool isMeasuring)
        {
            lock (gate)
            {
                (this.tick, this.isMeasuring) = (tick, isMeasuring);
                clock.Restart();
            }
        }

        private void Watch()
        {
            while (true)
            {
                Thread.Sleep(PollMs);
                lock (gate)
                {
                    if (isDisposed) return;
                    if (!clock.IsRunning) continue;
                    if (!isMeasuring && !manager.Simulation.IsOpen) clock.Restart();
                    if (clock.ElapsedMilliseconds <= 2L * manager.Settings.stepLimitMs) continue;
                    IsExceeded = true;
                    player.Abort();
                }
                Thread.Sleep(AbortMs);
                lock (gate) if (isDisposed) return;
                giveUp();
            }
        }
    }
}
