using System;

namespace Collektive.Headless.Bench
{
    /// <summary>One implementation of a tick. It is opened once, measured in several batches, and closed.</summary>
    internal abstract class Variant : IDisposable
    {
        protected Variant(string name, string variant, string program, int nodes, int threads)
        {
            Row = new Row(name, variant, program, nodes == 0 ? "none" : "8-neighbour grid", nodes, threads);
        }

        internal Row Row { get; }

        /// <summary>Whether its C# side runs in this process, so that managed bytes can be measured.</summary>
        internal virtual bool IsManaged => true;

        /// <summary>Whether it waits between ticks.</summary>
        internal virtual bool IsPaced => false;

        /// <summary>Calls per tick into the JVM of this process.</summary>
        internal virtual int CallsPerTick => 0;

        /// <summary>Microseconds of the rounds in each tick of the last batch; null when unknown.</summary>
        internal virtual double[] Rounds => null;

        /// <summary>Bytes allocated so far by the JVM that runs its rounds; -1 when unknown.</summary>
        internal abstract long JvmBytes();

        /// <summary>Runs <paramref name="count"/> ticks and writes their microseconds to <paramref name="times"/>.</summary>
        internal abstract void Run(int count, double[] times);

        public abstract void Dispose();
    }
}
