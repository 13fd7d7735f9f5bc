using System;
using System.Threading;
using Mono.Unix;
using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>
    /// Handles Ctrl-C and SIGTERM. The first signal during a run ends it after the current tick, with its outputs. A signal before the run, and the
    /// second one, end the process immediately, because user code may not return. One object for the whole process.
    /// </summary>
    internal sealed class Interrupt
    {
        // Console.CancelKeyPress comes only from a terminal.
        private readonly UnixSignal[] signals = { new UnixSignal(Signum.SIGINT), new UnixSignal(Signum.SIGTERM) };
        private volatile bool isPlaying;
        private volatile int number;

        internal Interrupt() => new Thread(Watch) { IsBackground = true }.Start();

        /// <summary>Whether the run is to end.</summary>
        internal bool Requested => number != 0;

        /// <summary>The exit code that shells use for a command that the signal ended.</summary>
        internal int ExitCode => 128 + number;

        /// <summary>Lets the run end itself when <see cref="Requested"/> is set.</summary>
        internal void BeginPlay() => isPlaying = true;

        private void Watch()
        {
            while (true)
            {
                var signal = signals[UnixSignal.WaitAny(signals)];
                signal.Reset();
                var isFirst = number == 0;
                number = (int)signal.Signum;
                if (isPlaying && isFirst) continue;
                Console.Error.WriteLine("collektive: interrupted " + (isPlaying ? "twice: the outputs are incomplete" : "before the first tick"));
                Syscall._exit(ExitCode);
            }
        }
    }
}
