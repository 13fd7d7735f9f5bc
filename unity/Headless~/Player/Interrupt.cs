using System;
using System.Diagnostics;
using System.Threading;
using Mono.Unix;
using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>
    /// Handles Ctrl-C and SIGTERM. The first signal during a run ends the run after the current tick, and its outputs are written. A second signal, or a signal
    /// before the run, ends the process immediately, because user code may not return. Signals within a second count as one, because <c>timeout</c> and Slurm
    /// signal the process as well as the command, which forwards the signal. A process must have only one object of this class.
    /// </summary>
    internal sealed class Interrupt
    {
        private const int SameSignalMs = 1000;

        // Console.CancelKeyPress is not used, because it is raised only for a terminal.
        private readonly UnixSignal[] signals = { new UnixSignal(Signum.SIGINT), new UnixSignal(Signum.SIGTERM) };
        private readonly Stopwatch sinceFirst = new Stopwatch();
        private volatile bool isPlaying;
        private volatile int number;

        internal Interrupt() => new Thread(Watch) { IsBackground = true }.Start();

        /// <summary>Whether the run must end.</summary>
        internal bool Requested => number != 0;

        /// <summary>The exit code that shells use for a command that this signal has ended.</summary>
        internal int ExitCode => 128 + number;

        /// <summary>Starts the period in which the first signal only sets <see cref="Requested"/>, and the run ends itself.</summary>
        internal void BeginPlay() => isPlaying = true;

        private void Watch()
        {
            while (true)
            {
                var signal = signals[UnixSignal.WaitAny(signals)];
                signal.Reset();
                sinceFirst.Start();
                number = (int)signal.Signum;
                if (isPlaying && sinceFirst.ElapsedMilliseconds < SameSignalMs) continue;
                Console.Error.WriteLine("collektive: interrupted " + (isPlaying ? "twice: the outputs are incomplete" : "before the first tick"));
                Program.Exit(ExitCode);
            }
        }
    }
}
