using System;
using Mono.Unix;
using Mono.Unix.Native;

namespace Collektive.Headless
{
    /// <summary>Ctrl-C and the wish of a job scheduler: they end the run after the tick at hand, in order and with its outputs.</summary>
    internal sealed class Interrupt : IDisposable
    {
        // Console.CancelKeyPress comes only from a terminal.
        private readonly UnixSignal interrupt = new UnixSignal(Signum.SIGINT);
        private readonly UnixSignal termination = new UnixSignal(Signum.SIGTERM);

        /// <summary>Whether the run is to end.</summary>
        internal bool Requested => interrupt.IsSet || termination.IsSet;

        /// <summary>What shells use for a command that the signal ended.</summary>
        internal int ExitCode => 128 + (int)(interrupt.IsSet ? Signum.SIGINT : Signum.SIGTERM);

        public void Dispose()
        {
            interrupt.Dispose();
            termination.Dispose();
        }
    }
}
