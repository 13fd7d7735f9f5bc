using System;
using System.Collections.Generic;
using System.Globalization;
using Collektive.Bridge;
using gradientascent;

namespace Collektive.Headless.Bench
{
    /// <summary>Reads the bytes allocated by this process's JVM, which a program of the benchmark prints.</summary>
    internal sealed class AllocationProbe : IDisposable
    {
        private const string Mark = "allocated-bytes ";
        private readonly Session session;
        private readonly HostLog log = new HostLog();

        internal AllocationProbe(IReadOnlyList<string> jars)
        {
            session = Session.Open(new SessionSettings { Jars = jars, Program = "allocated-bytes" }, new GradientAscentSchema());
            session.Request.AddNode(0, null, null);
        }

        internal long Read()
        {
            session.Request.ClearDue();
            session.Request.Sensors.EnsureCapacity(1);
            session.Request.AddDue(0);
            session.Step(Measurement.DeltaTime, Measurement.LimitMs);
            while (log.TryRead(out _, out var line))
            {
                var at = line.IndexOf(Mark, StringComparison.Ordinal);
                if (at >= 0) return long.Parse(line.Substring(at + Mark.Length), CultureInfo.InvariantCulture);
                Console.Error.WriteLine(line);
            }
            throw new BenchException("the JVM does not report its allocations");
        }

        public void Dispose() => session.Dispose();
    }
}
