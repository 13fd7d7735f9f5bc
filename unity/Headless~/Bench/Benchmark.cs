using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless.Bench
{
    /// <summary>Measures all variants in one run, in alternating batches, so that load on the machine slows all of them equally.</summary>
    internal sealed class Benchmark
    {
        private const int Batches = 5;
        private const int Threads = 2;

        private readonly BenchSettings settings;
        private readonly List<Row> rows = new List<Row>();
        private readonly Stopwatch clock = Stopwatch.StartNew();

        internal Benchmark(BenchSettings settings)
        {
            this.settings = settings;
        }

        internal void Run()
        {
            RunOwnProcess();
            Start(JvmPlacement.InProcess);
            using (var probe = new AllocationProbe(settings.Jars))
            using (var host = new Peer(settings))
            using (var engine = new Peer(settings))
            {
                foreach (var nodes in settings.Nodes) Measure(nodes, () => Ticks(probe, host, engine, nodes));
                Measure(0, () => new List<Variant> { new InProcess(settings, probe, "crossing", "in-process", 0, 1) });
                foreach (var nodes in new[] { 500, 10000 })
                    if (Array.IndexOf(settings.Nodes, nodes) >= 0) Measure(nodes, () => new List<Variant> { new Spawn(settings, probe, nodes, Threads) });
                if (!settings.Quick) rows.Add(new Soak(settings, probe, Log).Run());
            }
            Write();
            Table.Print(rows, Console.Out);
            Gates.Print(rows, Console.Out);
        }

        /// <summary>Must run first, because a JVM in this process remains until the end.</summary>
        private void RunOwnProcess()
        {
            Start(JvmPlacement.OwnProcess);
            using (var probe = new AllocationProbe(settings.Jars))
            {
                foreach (var nodes in settings.Nodes)
                    Measure(nodes, () => new List<Variant> { new InProcess(settings, probe, "tick", "own-process", nodes, Threads) });
                Measure(0, () => new List<Variant> { new InProcess(settings, probe, "crossing", "own-process", 0, 1) });
            }
        }

        private void Start(JvmPlacement placement) =>
            Jvm.Start(new JvmLaunch(settings.JavaHome, settings.HostJar, BenchSettings.JvmOptions) { Placement = placement });

        private List<Variant> Ticks(AllocationProbe probe, Peer host, Peer engine, int nodes)
        {
            var variants = new List<Variant>
            {
                new InProcess(settings, probe, "tick", "in-process", nodes, Threads),
                OnJvm.Engine(engine, nodes, Threads),
                new OverSocket(settings, host, nodes, Threads, paced: false),
                OnJvm.Loops(engine, nodes),
            };
            if (nodes <= (settings.Quick ? 1000 : 10000)) variants.Add(new PerNodeCall(settings, probe, nodes, Threads));
            if (nodes == 10000)
            {
                variants.Add(new InProcess(settings, probe, "tick", "in-process", nodes, 1));
                variants.Add(OnJvm.Engine(engine, nodes, 1));
            }
            if (nodes == 12 || nodes == 500 || nodes == 1000)
            {
                variants.Add(new PacedInProcess(settings, probe, nodes, Threads));
                variants.Add(new OverSocket(settings, host, nodes, Threads, paced: true));
            }
            return variants;
        }

        private void Measure(int nodes, Func<List<Variant>> make)
        {
            var variants = make();
            try
            {
                var times = new double[WarmUp(0)];
                foreach (var variant in variants)
                {
                    Log(variant.Row.Name + ", " + variant.Row.Variant + ", " + nodes + " nodes: warming up");
                    variant.Run(variant.IsPaced ? 20 : Math.Min(times.Length, WarmUp(Weight(variant))), times);
                }
                for (var batch = 0; batch < Batches; batch++)
                {
                    Log(nodes + " nodes: batch " + (batch + 1) + " of " + Batches);
                    foreach (var variant in variants) MeasureBatch(variant, times);
                }
            }
            finally
            {
                foreach (var variant in variants) variant.Dispose();
            }
            foreach (var variant in variants) rows.Add(variant.Row);
        }

        private void MeasureBatch(Variant variant, double[] times)
        {
            var count = BatchSize(Weight(variant), variant.IsPaced);
            var jvm = variant.JvmBytes();
            var calls = Jvm.StepCalls;
            var managed = GC.GetAllocatedBytesForCurrentThread();
            variant.Run(count, times);
            managed = GC.GetAllocatedBytesForCurrentThread() - managed;
            calls = Jvm.StepCalls - calls;
            if (calls != (ulong)(count * variant.CallsPerTick))
            {
                throw new BenchException(variant.Row.Variant + " made " + calls + " calls into the JVM in " + count + " ticks instead of "
                    + variant.CallsPerTick + " per tick");
            }
            jvm = variant.JvmBytes() - jvm;
            if (variant.Rounds != null) variant.Row.AddRounds(variant.Rounds, count);
            variant.Row.Add(times, count, variant.IsManaged ? (double)managed / count : -1, (double)jvm / count);
        }

        /// <summary>Number of nodes, or the equivalent amount of work.</summary>
        private static int Weight(Variant variant) => variant is PerNodeCall ? variant.Row.Nodes * 20 : variant is Spawn ? variant.Row.Nodes * 4
            : variant.Row.Nodes;

        /// <summary>Number of ticks until the compilers are done, and at least enough to fill the caches.</summary>
        private int WarmUp(int weight) => Math.Max(10, (settings.Quick ? 1500000 : 4000000) / Math.Max(weight, 400));

        private int BatchSize(int weight, bool paced) => paced ? 50
            : Math.Max(8, Math.Min(settings.Quick ? 300 : 1000, (settings.Quick ? 400000 : 1500000) / Math.Max(weight, 1)));

        private void Write()
        {
            var machine = Cpu() + ", " + Environment.ProcessorCount + " processors; " + Jvm.Description.Split('\n')[1] + "; CLR " + Environment.Version + "; " +
                Environment.OSVersion + "; JVM options " + string.Join(" ", BenchSettings.JvmOptions);
            var all = new JArray();
            foreach (var row in rows) all.Add(row.ToJson());
            File.WriteAllText(settings.Out, new JObject(new JProperty("machine", machine), new JProperty("rows", all)).ToString(Formatting.Indented) + "\n");
        }

        private static string Cpu()
        {
            var match = Regex.Match(File.ReadAllText("/proc/cpuinfo"), "model name\\s*: (.*)");
            return match.Success ? match.Groups[1].Value : "unknown processor";
        }

        private void Log(string text) => Console.Error.WriteLine("[" + (int)clock.Elapsed.TotalSeconds + " s] " + text);
    }
}
