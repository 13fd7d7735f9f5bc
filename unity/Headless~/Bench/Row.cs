using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless.Bench
{
    /// <summary>Measurements of one variant.</summary>
    internal sealed class Row
    {
        private readonly List<double> times = new List<double>();
        private readonly List<double> rounds = new List<double>();
        private readonly List<double> managedBytes = new List<double>();
        private readonly List<double> jvmBytes = new List<double>();

        internal Row(string name, string variant, string program, string topology, int nodes, int threads)
        {
            Name = name;
            Variant = variant;
            Program = program;
            Topology = topology;
            Nodes = nodes;
            Threads = threads;
        }

        internal string Name { get; }

        internal string Variant { get; }

        internal string Program { get; }

        internal string Topology { get; }

        internal int Nodes { get; }

        internal int Threads { get; }

        internal double Median => Quantiles.Of(times, 0.5);

        /// <summary>Time of the rounds in the median tick; 0 when unknown.</summary>
        internal double Rounds => rounds.Count == 0 ? 0 : Quantiles.Of(rounds, 0.5);

        internal double P99 => Quantiles.Of(times, 0.99);

        /// <summary>Minimum over all batches, because the runtimes themselves sometimes allocate; NaN when unknown.</summary>
        internal double ManagedBytes => Least(managedBytes);

        internal double JvmBytes => Least(jvmBytes);

        /// <summary>Additional values for this kind of row.</summary>
        internal JObject More { get; } = new JObject();

        /// <summary>Adds a batch: the microseconds of its ticks, and the bytes per tick; negative when unknown.</summary>
        internal void Add(double[] batch, int count, double managed, double jvm)
        {
            for (var i = 0; i < count; i++) times.Add(batch[i]);
            if (managed >= 0) managedBytes.Add(managed);
            if (jvm >= 0) jvmBytes.Add(jvm);
        }

        /// <summary>Adds the microseconds that the rounds of a batch's ticks took.</summary>
        internal void AddRounds(double[] batch, int count)
        {
            for (var i = 0; i < count; i++) rounds.Add(batch[i]);
        }

        internal double Quantile(double q) => Quantiles.Of(times, q);

        internal JObject ToJson()
        {
            var json = new JObject(
                new JProperty("name", Name), new JProperty("variant", Variant), new JProperty("program", Program), new JProperty("topology", Topology),
                new JProperty("nodes", Nodes), new JProperty("threads", Threads), new JProperty("median_us", Round(Median)),
                new JProperty("p99_us", Round(P99)),
                new JProperty("min_us", Round(Quantile(0))), new JProperty("managed_bytes_per_tick", Bytes(ManagedBytes)),
                new JProperty("jvm_bytes_per_tick", Bytes(JvmBytes)));
            json.Merge(More);
            return json;
        }

        private static double Least(List<double> values)
        {
            var least = double.NaN;
            foreach (var value in values) if (!(value >= least)) least = value;
            return least;
        }

        private static double Round(double value) => Math.Round(value, 2);

        private static JToken Bytes(double value) => double.IsNaN(value) ? JValue.CreateNull() : new JValue((long)Math.Round(value));
    }
}
