using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>
    /// Writes metrics.csv, which has a row per interval, by default per simulated second. Counts of messages are sums over the ticks of the interval. Times are
    /// means per tick in milliseconds. The phases add up to the tick, because "other_ms" is the time outside the phases of <see cref="TickTimes"/>.
    /// </summary>
    internal sealed class MetricsTable : IDisposable
    {
        private readonly TextWriter writer;
        private readonly RunMetrics metrics;
        private readonly SimulationManager manager;
        private static readonly string[] Counts = { "links", "sent", "dropped", "delayed", "expired" };
        private static readonly string[] Times =
        {
            "queries_ms", "rules_ms", "sense_ms", "step_ms", "act_ms", "physics_ms", "other_ms", "tick_ms", "tick_ms_p99",
        };

        private readonly double[] values;
        private readonly double[] row;
        private readonly List<double> whole = new List<double>();
        private double queries, rules, sense, step, act, physics;
        private int ticks;
        private long sent, dropped, delayed, expired;

        internal MetricsTable(string path, RunMetrics metrics, SimulationManager manager)
        {
            this.metrics = metrics;
            this.manager = manager;
            values = new double[metrics.Names.Count];
            row = new double[values.Length + Counts.Length];
            writer = path == null ? TextWriter.Null : ResultFile.Create(path);
            writer.Write("second," + string.Join(",", NamesOf(metrics).Concat(Times).Select(CsvText.Header)) + "\n");
        }

        /// <summary>The values of the run's metrics when they were last evaluated.</summary>
        internal IReadOnlyList<double> Values => values;

        /// <summary>Returns the names of the reproducible columns: the metrics of the run, then the counts of links and messages.</summary>
        internal static IEnumerable<string> NamesOf(RunMetrics metrics)
        {
            foreach (var name in metrics.Names) yield return name;
            foreach (var name in Counts) yield return name;
        }

        /// <summary>Returns the first metric that has the name of another column, or null.</summary>
        internal static string FindDuplicate(RunMetrics metrics)
        {
            var known = new HashSet<string>(Counts.Concat(Times)) { "second" };
            foreach (var name in metrics.Names)
                if (!known.Add(name)) return name;
            return null;
        }

        /// <summary>Adds the phases and messages of a tick.</summary>
        internal void Add(TickTimes times, NetworkCounts network)
        {
            ticks++;
            queries += times.Queries;
            rules += times.Rules;
            sense += times.Sense;
            step += times.Step;
            act += times.Act;
            physics += times.Physics;
            sent += network.Sent;
            dropped += network.Dropped;
            delayed += network.Delayed;
            expired += network.Expired;
        }

        /// <summary>Adds the milliseconds from the end of the previous tick to the end of this tick.</summary>
        internal void AddWhole(double milliseconds) => whole.Add(milliseconds);

        /// <summary>Evaluates the metrics at the current time.</summary>
        internal void Measure() => metrics.Measure(manager, values);

        /// <summary>
        /// Writes the row of an interval that has ended. Returns the row without measured times, in the order of <see cref="NamesOf"/>. It is valid until
        /// the next call.
        /// </summary>
        internal IReadOnlyList<double> EndInterval(double second, int links)
        {
            Measure();
            values.CopyTo(row, 0);
            new double[] { links, sent, dropped, delayed, expired }.CopyTo(row, values.Length);
            var text = second.ToString("0.######", CultureInfo.InvariantCulture);
            foreach (var value in row) text += "," + CsvText.Number(value);
            var all = 0.0;
            foreach (var time in whole) all += time;
            var phases = queries + rules + sense + step + act + physics;
            foreach (var time in new[] { queries, rules, sense, step, act, physics, all - phases, all })
                text += "," + Text(time / Math.Max(1, ticks));
            text += "," + Text(Quantiles.Of(whole, 0.99));
            writer.Write(text + "\n");
            // If the run is killed, the rows so far remain.
            writer.Flush();
            whole.Clear();
            ticks = 0;
            queries = rules = sense = step = act = physics = 0;
            sent = dropped = delayed = expired = 0;
            return row;
        }

        internal void RequireInPlace() => ResultFile.RequireInPlace(writer);

        public void Dispose() => writer.Dispose();

        private static string Text(double value) => value.ToString("0.####", CultureInfo.InvariantCulture);
    }
}
