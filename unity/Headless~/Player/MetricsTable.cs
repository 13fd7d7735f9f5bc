using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>
    /// metrics.csv: a row per interval, by default a simulated second; messages are sums over the interval's ticks. Times are means in milliseconds, so that
    /// the phases of a tick add up to it: what is no phase of <see cref="TickTimes"/> is "other".
    /// </summary>
    internal sealed class MetricsTable : IDisposable
    {
        private readonly TextWriter writer;
        private readonly SceneBuilder scene;
        private readonly double[] values;
        private readonly List<double> whole = new List<double>();
        private double rules, sense, step, act, physics;
        private int ticks;
        private long sent, dropped, delayed, expired;

        internal MetricsTable(string path, SceneBuilder scene)
        {
            this.scene = scene;
            values = new double[scene.MetricNames.Count];
            writer = path == null ? TextWriter.Null : new StreamWriter(path);
            var names = values.Length == 0 ? "" : string.Join(",", scene.MetricNames) + ",";
            writer.Write("second," + names + "links,sent,dropped,delayed,expired,sense_ms,rules_ms,step_ms,act_ms,physics_ms,other_ms,tick_ms,tick_ms_p99\n");
        }

        /// <summary>The scene's metrics at the last row.</summary>
        internal IReadOnlyList<double> Values => values;

        /// <summary>Adds a tick.</summary>
        internal void Add(TickTimes times, NetworkCounts network)
        {
            ticks++;
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

        /// <summary>Adds what passed on the clock from the end of the former tick to the end of this one, in milliseconds.</summary>
        internal void AddWhole(double milliseconds) => whole.Add(milliseconds);

        internal void EndInterval(double second, int links)
        {
            scene.Measure(values);
            var row = second.ToString("0.######", CultureInfo.InvariantCulture);
            foreach (var value in values) row += "," + Text(value);
            row += "," + links.ToString(CultureInfo.InvariantCulture);
            foreach (var count in new[] { sent, dropped, delayed, expired }) row += "," + count.ToString(CultureInfo.InvariantCulture);
            var all = 0.0;
            foreach (var time in whole) all += time;
            foreach (var time in new[] { sense, rules, step, act, physics, all - sense - rules - step - act - physics, all })
                row += "," + Text(time / Math.Max(1, ticks));
            row += "," + Text(Quantiles.Of(whole, 0.99));
            writer.Write(row + "\n");
            // A run that is killed keeps what it has measured.
            writer.Flush();
            whole.Clear();
            ticks = 0;
            rules = sense = step = act = physics = 0;
            sent = dropped = delayed = expired = 0;
        }

        public void Dispose() => writer.Dispose();

        private static string Text(double value) => value.ToString("0.####", CultureInfo.InvariantCulture);
    }
}
