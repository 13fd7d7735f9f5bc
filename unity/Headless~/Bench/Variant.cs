using System;

namespace Collektive.Headless.Bench
{
    /// <summary>One way to do a tick of one world. Opened once, measured in several batches, closed.</summary>
    internal abstract class Variant : IDisposable
    {
        protected Variant(string name, string variant, string program, int nodes, int threads)
        {
            Row = new Row(name, variant, program, nodes == 0 ? "none" : "8-neighbour grid", nodes, threads);
        }

        internal Row Row { get; }

        /// <summary>Whether its C# side runs in this process, so that managed bytes mean something.</summary>
        internal virtual bool IsManaged => true;

        /// <summary>Whether it waits between ticks.</summary>
        internal virtual bool IsPaced => false;

        /// <summary>Calls into the JVM of this process that a tick makes.</summary>
        internal virtual int CallsPerTick => 0;

        /// <summary>Microseconds of the rounds in each of the ticks done last; null when unknown.</summary>
        internal virtual double[] Rounds => null;

        /// <summary>Bytes that the JVM which runs its rounds has allocated so far; -1 when unknown.</summary>
        internal abstract long JvmBytes();

        /// <summary>Does <paramref name="count"/> ticks and puts their microseconds into <paramref name="times"/>.</summary>
        internal abstract void Run(int count, double[] times);

        public abstract void Dispose();
    }
}
