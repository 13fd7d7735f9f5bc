using System;
using System.Globalization;
using System.IO;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless.Bench
{
    /// <summary>
    /// A long run that measures tail latency, garbage collection and memory growth. Like all measurements, it begins when the
    /// compilers are done and the heap has been collected.
    /// </summary>
    internal sealed class Soak
    {
        private const int Nodes = 1000;
        private const int WarmUp = 4000;
        private const int Ticks = 20000;
        private const int SettledAt = 5000;
        private const int Batch = 1000;

        private readonly BenchSettings settings;
        private readonly AllocationProbe probe;
        private readonly Action<string> log;

        internal Soak(BenchSettings settings, AllocationProbe probe, Action<string> log)
        {
            this.settings = settings;
            this.probe = probe;
            this.log = log;
        }

        internal Row Run()
        {
            using (var variant = new InProcess(settings, probe, "soak", "in-process", Nodes, 2))
            {
                var times = new double[Batch];
                log("soak, " + Nodes + " nodes: warming up");
                for (var done = 0; done < WarmUp; done += Batch) variant.Run(Batch, times);
                var before = Jvm.GetStatus(collect: true);
                var rssAtStart = ResidentKb();
                var rssSettled = 0L;
                for (var done = 0; done < Ticks; done += Batch)
                {
                    log("soak, " + Nodes + " nodes: tick " + done + " of " + Ticks);
                    if (done == SettledAt) rssSettled = ResidentKb();
                    var jvm = variant.JvmBytes();
                    var managed = GC.GetAllocatedBytesForCurrentThread();
                    variant.Run(Batch, times);
                    managed = GC.GetAllocatedBytesForCurrentThread() - managed;
                    variant.Row.Add(times, Batch, (double)managed / Batch, (double)(variant.JvmBytes() - jvm) / Batch);
                }
                var after = Jvm.GetStatus();
                var more = variant.Row.More;
                more.Add(new JProperty("p999_us", Math.Round(variant.Row.Quantile(0.999), 2)));
                more.Add(new JProperty("max_us", Math.Round(variant.Row.Quantile(1), 2)));
                more.Add(new JProperty("gc_pauses", after.Collections - before.Collections));
                more.Add(new JProperty("gc_pause_ms", after.CollectionMs - before.CollectionMs));
                more.Add(new JProperty("rss_kb_start", rssAtStart));
                more.Add(new JProperty("rss_kb_tick_5000", rssSettled));
                more.Add(new JProperty("rss_kb_end", ResidentKb()));
                return variant.Row;
            }
        }

        private static long ResidentKb() =>
            long.Parse(Regex.Match(File.ReadAllText("/proc/self/status"), "VmRSS:\\s*(\\d+)").Groups[1].Value, CultureInfo.InvariantCulture);
    }
}
